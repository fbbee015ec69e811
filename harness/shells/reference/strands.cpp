#include "harness/shells/reference/strands.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "harness/parallel.hpp"
#include "harness/prepare/strands.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/shells/reference/vector.hpp"

namespace pelage::reference {
namespace {

/// Returns the wind force at `time` in newtons: d * strength * (1 + gust * sin(2 pi frequency * time - p)). d
/// is the unit vector of wind.direction. `phase` contains the cosine and the sine of the angle p.
glm::dvec3 wind_force(const WindScene& wind, const glm::dvec2& phase, double time) {
  const double turn = 2.0 * std::numbers::pi * double(wind.frequency) * time;
  const double sine = std::sin(turn) * phase.x - std::cos(turn) * phase.y;  // phase: (cos, sin)
  return unit(glm::dvec3(wind.direction)) * (double(wind.strength) * (1.0 + double(wind.gust) * sine));
}

}  // namespace

Strand constrain(Strand strand, const glm::dvec3& normal, double length) {
  const double height = glm::dot(strand.tip, normal);
  if (height < 0.0) {
    strand.tip -= height * normal;
    strand.velocity -= std::min(0.0, glm::dot(strand.velocity, normal)) * normal;
  }
  if (glm::length(strand.tip) > length) {
    const glm::dvec3 outward = unit(strand.tip);
    strand.tip = length * outward;
    strand.velocity -= std::max(0.0, glm::dot(strand.velocity, outward)) * outward;
  }
  return strand;
}

Strand rest(const FrameInput& input, std::size_t face) {
  return {glm::dvec3(input.strands.anchor[face]), glm::dvec3(0.0)};
}

FrameForces::FrameForces(const FrameInput& input, int first, int frames)
    : always_(input.scene.dynamics), first_(std::size_t(first)) {
  if (!forces_change(input.scene)) return;
  for (int i = 0; i < frames; ++i) frame_.push_back(dynamics_of_frame(input.scene, first + i));
}

const DynamicsScene& FrameForces::at(std::size_t substep) const {
  return frame_.empty() ? always_ : frame_.at(substep / std::size_t(always_.substeps) - first_);
}

Strand substep(const FrameInput& input, std::size_t face, Strand strand, std::size_t index) {
  const int frame = int(index / std::size_t(input.scene.dynamics.substeps));
  return substep(input, FrameForces(input, frame, 1), face, strand, index);
}

Strand substep(const FrameInput& input, const FrameForces& forces, std::size_t face, Strand strand,
               std::size_t index) {
  const DynamicsScene& dynamics = forces.at(index);
  const glm::dvec2 phase(forces.change() ? gust_phase(glm::dvec3(input.strands.root[face]), dynamics.wind)
                                         : input.strands.phase[face]);
  const double mass = double(dynamics.mass), dt = double(dynamics.step);
  const glm::dvec3 anchor(input.strands.anchor[face]);
  const glm::dvec3 force = double(dynamics.stiffness) * (anchor - strand.tip) -
                           double(dynamics.drag) * strand.velocity + mass * glm::dvec3(dynamics.gravity) +
                           wind_force(dynamics.wind, phase, double(index) * dt);
  strand.velocity += dt / mass * force;
  strand.tip += dt * strand.velocity;
  const glm::dvec3 normal(input.strands.normal[face]);
  if (has_contact(input.scene.contact))
    strand =
        Colliders(input, double(index + 1) * dt).push(strand, glm::dvec3(input.strands.root[face]), normal);
  return constrain(strand, normal, double(strand_length(input.scene.fur, input.style, face)));
}

namespace {

Strand simulated(const FrameInput& input, const FrameForces& forces, std::size_t face, int frames) {
  const std::size_t count = std::size_t(std::max(0, frames)) * std::size_t(input.scene.dynamics.substeps);
  Strand strand = rest(input, face);
  for (std::size_t i = 0; i < count; ++i) strand = substep(input, forces, face, strand, i);
  return strand;
}

}  // namespace

Strand simulate(const FrameInput& input, std::size_t face, int frames) {
  return simulated(input, FrameForces(input, 0, frames), face, frames);
}

std::vector<Strand> simulate(const FrameInput& input, int frames) {
  const FrameForces forces(input, 0, frames);
  std::vector<Strand> strands(input.strands.anchor.size());
  for_each_index(strands.size(), 256,
                 [&](std::size_t face) { strands[face] = simulated(input, forces, face, frames); });
  return strands;
}

namespace {

constexpr int march_steps = 16, halvings = 8;

/// Returns the point of the segment from a to b that is nearest to p.
glm::dvec3 nearest_on(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& p) {
  const glm::dvec3 axis = b - a;
  const double square = glm::dot(axis, axis);
  return square > 0.0 ? a + std::clamp(glm::dot(p - a, axis) / square, 0.0, 1.0) * axis : a;
}

Strand stopped(Strand strand, double depth, const glm::dvec3& n, const glm::dvec3& velocity) {
  strand.tip += depth * n;
  strand.velocity -= std::min(0.0, glm::dot(strand.velocity - velocity, n)) * n;
  return strand;
}

/// Returns the derivatives of the field with respect to the position: those of the trilinear interpolation.
glm::dvec3 slope_at(const DistanceField& field, const glm::dvec3& point) {
  // The interpolation is linear along each axis within a cell. A difference over a part of the cell around
  // the point is therefore exact.
  glm::dvec3 slope;
  for (int k = 0; k < 3; ++k) {
    const double at = std::clamp((point[k] - double(field.origin[k])) / double(field.cell), 0.0,
                                 double(field.nodes[k] - 1));
    const double cell = std::min(std::floor(at), double(field.nodes[k] - 2));
    glm::dvec3 low = point, high = point;
    low[k] = double(field.origin[k]) + (cell + 0.25) * double(field.cell);
    high[k] = double(field.origin[k]) + (cell + 0.75) * double(field.cell);
    slope[k] = (value_at(field, high) - value_at(field, low)) / (0.5 * double(field.cell));
  }
  return slope;
}

}  // namespace

Colliders::Colliders(const FrameInput& input, double time) {
  const ContactScene& scene = input.scene.contact;
  for (const ContactSphereScene& s : scene.spheres) {
    const glm::dvec3 centre = s.motion.moved(s.centre, time);
    if (s.motion.exists(time))
      capsules_.push_back({centre, centre, double(s.radius), glm::dvec3(s.motion.velocity)});
  }
  for (const ContactCapsuleScene& c : scene.capsules)
    if (c.motion.exists(time))
      capsules_.push_back({c.motion.moved(c.from, time), c.motion.moved(c.to, time), double(c.radius),
                           glm::dvec3(c.motion.velocity)});
  if (!input.contact_field || !scene.mesh.motion.exists(time)) return;
  field_ = input.contact_field.get();
  position_ = scene.mesh.motion.moved(scene.mesh.position, time);
  velocity_ = glm::dvec3(scene.mesh.motion.velocity);
  scale_ = double(scene.mesh.scale);
}

double Colliders::mesh_distance(const glm::dvec3& point) const {
  return scale_ * value_at(*field_, (point - position_) / scale_);
}

double Colliders::distance(const glm::dvec3& point) const {
  double least = std::numeric_limits<double>::max();
  for (const Capsule& c : capsules_)
    least = std::min(least, glm::length(point - nearest_on(c.from, c.to, point)) - c.radius);
  return field_ ? std::min(least, mesh_distance(point)) : least;
}

Strand Colliders::push(Strand strand, const glm::dvec3& root, const glm::dvec3& normal) const {
  for (const Capsule& c : capsules_) {
    const glm::dvec3 from = root + strand.tip - nearest_on(c.from, c.to, root + strand.tip);
    const double distance = glm::length(from);
    if (distance < c.radius)
      strand = stopped(strand, c.radius - distance, distance > 1e-12 ? from / distance : normal, c.velocity);
  }
  if (!field_) return strand;
  const glm::dvec3 point = root + strand.tip;
  const double distance = mesh_distance(point);
  if (distance >= 0.0) return strand;
  const glm::dvec3 slope = slope_at(*field_, (point - position_) / scale_);
  return stopped(strand, -distance, glm::length(slope) > 1e-12 ? unit(slope) : normal, velocity_);
}

glm::dvec3 Colliders::kept(const glm::dvec3& root, const glm::dvec3& along) const {
  if (!(glm::length(along) > 0.0)) return along;
  const auto in_capsule = [&](const Capsule& c, double share) {
    const glm::dvec3 p = root + share * along;
    return glm::length(p - nearest_on(c.from, c.to, p)) < c.radius;
  };
  double share = 1.0;
  // A collider may move the vertex into another one. Each pass moves it out of at least one collider.
  for (std::size_t pass = 0; pass < capsules_.size() + 1; ++pass) {
    for (const Capsule& c : capsules_) {
      if (!in_capsule(c, share)) continue;
      // A capsule is convex, so the points of the line inside the capsule form one interval. If the root is
      // inside, the result is 0. Otherwise bisection finds the lower end of the interval.
      double low = 0.0, high = share;
      if (in_capsule(c, 0.0)) high = 0.0;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (in_capsule(c, middle) ? high : low) = middle;
      }
      share = low;
    }
    if (!field_ || mesh_distance(root + share * along) >= 0.0) continue;
    const auto outside = [&](double at) { return mesh_distance(root + at * along) >= 0.0; };
    const double start = share;
    share = 0.0;
    for (int k = 1; k < march_steps; ++k) {
      double low = start * (1.0 - double(k) / march_steps);
      if (!outside(low)) continue;
      double high = start * (1.0 - double(k - 1) / march_steps);
      for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (outside(middle) ? low : high) = middle;
      }
      share = low;
      break;
    }
  }
  return share * along;
}

double time_after(const DynamicsScene& dynamics, int frames) {
  return double(frames) * double(dynamics.substeps) * double(dynamics.step);
}

}  // namespace pelage::reference
