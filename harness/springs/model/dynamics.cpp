#include "harness/springs/model/dynamics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/error.hpp"
#include "harness/springs/model/motion.hpp"

namespace pelage::springs {
namespace {

void finite(const char* what, float value) {
  if (!std::isfinite(value)) throw InputError(fmt::format("{}: {}; it must be a finite number", what, value));
}

void finite(const char* what, glm::vec3 v) {
  for (int c = 0; c < 3; ++c)
    if (!std::isfinite(v[c]))
      throw InputError(
          fmt::format("{}: ({}, {}, {}); all three components must be finite", what, v.x, v.y, v.z));
}

void above_0(const char* what, float value) {
  finite(what, value);
  if (!(value > 0)) throw InputError(fmt::format("{}: {}; it must be above 0", what, value));
}

void not_negative(const char* what, float value) {
  finite(what, value);
  if (value < 0) throw InputError(fmt::format("{}: {}; it must not be negative", what, value));
}

void direction(const char* what, glm::vec3 v) {
  finite(what, v);
  if (v == glm::vec3(0))
    throw InputError(fmt::format("{}: (0, 0, 0); a direction must not be the zero vector", what));
}

Moment moment(const Dynamics& d, double time) {
  constexpr double turn = 2 * std::numbers::pi;
  const Pose pose = pose_at(d.motion, time);
  const glm::dvec3 air = double(d.wind.speed) * glm::normalize(glm::dvec3(d.wind.direction));

  const auto seen = [&](glm::dvec3 v) { return glm::vec3(turned(v, pose.axis, -pose.angle)); };
  const double drag = double(d.drag);
  const glm::vec3 steady =
      seen(double(d.mass) * (glm::dvec3(d.gravity) - pose.acceleration) + drag * (air - pose.velocity));
  const glm::vec3 gusts = seen(drag * double(d.wind.gust) * air);
  const glm::vec3 o(pose.rate * pose.axis), u(pose.rate_up * pose.axis);
  const double gust = turn * double(d.wind.frequency) * time;
  return {
      steady.x, steady.y, steady.z, gusts.x, gusts.y, gusts.z, float(std::sin(gust)), float(std::cos(gust)),
      o.x,      o.y,      o.z,      u.x,     u.y,     u.z};
}

}  // namespace

void check(const Dynamics& d) {
  above_0("time step (s)", d.step);
  above_0("mass (kg)", d.mass);
  not_negative("stiffness of the sticks (N/m)", d.stiffness);
  not_negative("damping of the sticks (N s/m)", d.damping);
  not_negative("stiffness of the springs between tops (N/m)", d.edge_stiffness);
  not_negative("damping of the springs between tops (N s/m)", d.edge_damping);
  not_negative("drag coefficient (N s/m)", d.drag);
  not_negative("weight of the return force (N)", d.return_weight);
  above_0("residual of conjugate gradients", d.residual);
  if (d.most_iterations < 1)
    throw InputError(
        fmt::format("limit of conjugate gradient iterations: {}; it must be at least 1", d.most_iterations));
  finite("limit of a stick's length (in rest lengths)", d.lost_stretch);
  if (!(d.lost_stretch > 1))
    throw InputError(
        fmt::format("limit of a stick's length: {} rest lengths; it must be above 1", d.lost_stretch));
  finite("gravity (m/s^2)", d.gravity);
  direction("direction of the wind", d.wind.direction);
  finite("speed of the wind (m/s)", d.wind.speed);
  finite("gust of the wind (amplitude as a fraction of the wind's speed)", d.wind.gust);
  not_negative("frequency of the gusts (Hz)", d.wind.frequency);
  above_0("wavelength of the gusts (R)", d.wind.wavelength);
  finite("velocity of the object (R/s)", d.motion.velocity);
  finite("shake of the object (amplitude in R)", d.motion.shake);
  not_negative("frequency of the object's shake (Hz)", d.motion.shake_frequency);
  direction("rotation axis of the object", d.motion.axis);
  finite("spin of the object (angular velocity in rad/s)", d.motion.spin);
  finite("swing of the object (amplitude in rad)", d.motion.swing);
  not_negative("frequency of the object's swing (Hz)", d.motion.swing_frequency);
}

std::vector<Moment> moments(const Dynamics& dynamics, long first, int substeps) {
  std::vector<Moment> found;
  for (int i = 0; i <= 2 * substeps; ++i)
    found.push_back(moment(dynamics, (double(first) + 0.5 * i) * double(dynamics.step)));
  return found;
}

TopologyParams params(const Dynamics& d, float length) {
  TopologyParams p{};
  p.length = length;
  p.mass = d.mass;
  p.inverse_mass = 1.0f / d.mass;
  p.stiffness = d.stiffness;
  p.damping = d.damping;
  p.edge_stiffness = d.edge_stiffness;
  p.edge_damping = d.edge_damping;
  p.drag = d.drag;
  p.return_weight = d.return_weight;
  p.step = d.step;
  p.most_square = d.lost_stretch * length * d.lost_stretch * length;
  p.moving = turns(d.motion);
  return p;
}

Wind wind_of(const WindScene& w, float drag) {
  return {w.direction, drag > 0 ? w.strength / drag : 0, w.gust, w.frequency, w.wavelength};
}

Motion motion_of(const MotionScene& m) {
  return {m.velocity, m.shake, m.shake_frequency, m.axis, m.spin, m.swing, m.swing_frequency};
}

double gust_phase(const Wind& wind, glm::dvec3 at) {
  const glm::dvec3 along = glm::normalize(glm::dvec3(wind.direction));
  return 2 * std::numbers::pi * glm::dot(at, along) / double(wind.wavelength);
}

bool turns(const Motion& m) {
  return m.spin != 0 || (m.swing != 0 && m.swing_frequency != 0);
}

Pose pose_at(const Motion& m, double time) {
  constexpr double turn = 2 * std::numbers::pi;
  const double a = turn * double(m.shake_frequency), b = turn * double(m.swing_frequency);
  return {glm::dvec3(m.velocity) + a * std::sin(a * time) * glm::dvec3(m.shake),
          a * a * std::cos(a * time) * glm::dvec3(m.shake),
          glm::normalize(glm::dvec3(m.axis)),
          double(m.spin) * time + double(m.swing) * std::sin(b * time),
          double(m.spin) + double(m.swing) * b * std::cos(b * time),
          -double(m.swing) * b * b * std::sin(b * time)};
}

// Rodrigues' formula.
glm::dvec3 turned(glm::dvec3 v, glm::dvec3 axis, double angle) {
  return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
         axis * glm::dot(axis, v) * (1 - std::cos(angle));
}

}  // namespace pelage::springs
