// A second formulation of a strand's motion, for the tests of the reference: two point masses in Cartesian
// coordinates, joined by rods with unknown tensions. This header also has the strands and scenes of the
// tests.
#pragma once
#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>

#include "harness/strands/reference/chain.hpp"

namespace pelage::strands::reference {

using Vec = glm::dvec3;

inline Vec orthogonal(Vec v, Vec direction) {
  return v - glm::dot(v, direction) * direction;
}

inline std::array<Vec, 2> tangents(Vec v) {
  const Vec one = glm::normalize(glm::cross(v, std::abs(v.x) < 0.6 ? Vec(1, 0, 0) : Vec(0, 1, 0)));
  return {one, glm::cross(v, one)};
}

// The strand as two point masses, for a root at rest and a steady wind. Lengths are in L.
struct Masses {
  double l1, l2, m1, m2, drag, d1, d2, k1, k2;
  Vec rest, gravity, air;

  Masses(const Chain& c, const ChainDynamics& s)
      : l1(double(s.first_segment)),
        l2(1 - l1),
        m1(1 - double(s.tip_mass)),
        m2(1 - m1),
        drag(double(c.drag) * double(s.drag)),
        d1(double(c.damping) * double(s.damping_first)),
        d2(double(c.damping) * double(s.damping_second)),
        k1(double(c.stiffness_first)),
        k2(double(c.stiffness_second)),
        rest(c.rest),
        gravity(Vec(s.gravity) / double(c.length)),
        air(double(s.wind.speed) / double(c.length) * glm::normalize(Vec(s.wind.direction))) {}

  double potential(const State& s) const {
    const Vec joint = l1 * s.u, tip = joint + l2 * s.w, pull = gravity + drag * air;
    return k1 * (1 - glm::dot(s.u, rest)) + k2 * (1 - glm::dot(s.u, s.w)) - m1 * glm::dot(pull, joint) -
           m2 * glm::dot(pull, tip);
  }
  double kinetic(const State& s) const {
    const Vec joint = l1 * s.a, tip = joint + l2 * s.b;
    return m1 / 2 * glm::dot(joint, joint) + m2 / 2 * glm::dot(tip, tip);
  }
  // Returns the energy that drag and damping remove per second.
  double loss(const State& s) const {
    const Vec joint = l1 * s.a, tip = joint + l2 * s.b, bend = s.b - s.a;
    return drag * (m1 * glm::dot(joint, joint) + m2 * glm::dot(tip, tip)) + d1 * glm::dot(s.a, s.a) +
           d2 * glm::dot(bend, bend);
  }
  // Returns the derivative of the state with respect to time. The tensions t1 and t2 of the rods are the
  // Lagrange multipliers of the constant lengths: u . joint'' = -l1 |a|^2, w . (tip'' - joint'') = -l2 |b|^2.
  State derivative(const State& s) const {
    const Vec joint = l1 * s.a, tip = joint + l2 * s.b;
    const Vec on_u = k1 * rest + k2 * s.w - d1 * s.a + d2 * (s.b - s.a), on_w = k2 * s.u - d2 * (s.b - s.a);
    const Vec on_joint = m1 * (gravity + drag * (air - joint)) + on_u / l1 - on_w / l2;
    const Vec on_tip = m2 * (gravity + drag * (air - tip)) + on_w / l2;
    const double bend = glm::dot(s.u, s.w);
    const double first = glm::dot(s.u, on_joint) + m1 * l1 * glm::dot(s.a, s.a);
    const double second = glm::dot(s.w, on_tip / m2 - on_joint / m1) + l2 * glm::dot(s.b, s.b);
    const double t2 = (second + bend * first / m1) / (1 / m1 + 1 / m2 - bend * bend / m1);
    const double t1 = first + bend * t2;
    const Vec joint_2 = (on_joint - t1 * s.u + t2 * s.w) / m1, tip_2 = (on_tip - t2 * s.w) / m2;
    return {s.a, s.b, joint_2 / l1, (tip_2 - joint_2) / l2};
  }
  State runge_kutta(State s, double until, int steps) const {
    const auto plus = [](State p, const State& q, double t) {
      p.u += t * q.u, p.w += t * q.w, p.a += t * q.a, p.b += t * q.b;
      return p;
    };
    const double h = until / steps;
    for (int i = 0; i < steps; ++i) {
      const State one = derivative(s), two = derivative(plus(s, one, h / 2));
      const State three = derivative(plus(s, two, h / 2)), four = derivative(plus(s, three, h));
      s = plus(plus(plus(plus(s, one, h / 6), two, h / 3), three, h / 3), four, h / 6);
    }
    return s;
  }
};

// Returns a strand whose stops (limits of angles, and the skin) are far away, with its own drag and damping.
inline Chain strand(glm::vec3 rest) {
  Chain c;
  c.rest = c.normal = rest;
  c.length = 0.2f;
  c.limit_first = c.limit_second = 120;
  c.drag = 1.25f;
  c.damping = 0.75f;
  return c;
}

// Returns dynamics without external forces and damping. The two segments have unequal lengths, and the two
// masses are unequal, so that exchanged symbols change the results of the tests.
inline ChainDynamics still(float step) {
  ChainDynamics s;
  s.step = step;
  s.first_segment = 0.4f;
  s.tip_mass = 0.3f;
  s.drag = s.damping_first = s.damping_second = 0;
  s.gravity = glm::vec3(0);
  return s;
}

// Returns the dynamics with all forces, for a root at rest.
inline ChainDynamics windy(float step) {
  ChainDynamics s = still(step);
  s.drag = 4;
  s.damping_first = 0.2f;
  s.damping_second = 0.3f;
  s.gravity = {3, -9.81f, 1};
  s.wind.direction = {0, 1, 2};
  s.wind.speed = 2;
  return s;
}

// Returns a random state whose directions differ from `rest` by at most about 40 degrees.
inline State random_state(std::mt19937& random, Vec rest, double rate) {
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&] {
    const double x = number(random), y = number(random), z = number(random);
    return Vec(x, y, z);
  };
  State s;
  s.u = glm::normalize(rest + 0.4 * vector());
  s.w = glm::normalize(rest + 0.4 * vector());
  s.a = orthogonal(rate * vector(), s.u);
  s.b = orthogonal(rate * vector(), s.w);
  return s;
}

inline std::array<double, 4> gaps(const Chain& c, const ChainDynamics& s, const State& state, double time) {
  const springs::Pose pose = springs::pose_at(s.motion, time);
  const Vec d = springs::turned(Vec(c.rest), pose.axis, pose.angle);
  const Vec n = springs::turned(Vec(c.normal), pose.axis, pose.angle);
  const Vec tip = double(s.first_segment) * state.u + (1 - double(s.first_segment)) * state.w;
  return {glm::dot(state.u, d) - std::cos(glm::radians(double(c.limit_first))), glm::dot(n, state.u),
          glm::dot(state.u, state.w) - std::cos(glm::radians(double(c.limit_second))), glm::dot(n, tip)};
}

// Returns the derivatives of `value` along the two tangents of u and the two tangents of w.
inline std::array<double, 4> gradient(const State& state, const std::function<double(const State&)>& value) {
  constexpr double distance = 1e-5;
  std::array<double, 4> found{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto at = [&](double offset) {
      State s = state;
      Vec& v = i < 2 ? s.u : s.w;
      v = glm::normalize(v + offset * tangents(v)[i % 2]);
      return value(s);
    };
    found[i] = (at(distance) - at(-distance)) / (2 * distance);
  }
  return found;
}

// The matrices of the equation M x'' + D x' + K x = 0 of small oscillations about the rest direction. x
// contains the displacements of u and w along one tangent. Gravity must point along the rest direction.
struct Linear {
  Eigen::Matrix2d M, D, K;
};

inline Linear linear(const Masses& m) {
  Eigen::Matrix2d to_positions;  // maps x to the displacements of joint and tip
  to_positions << m.l1, 0, m.l1, m.l2;
  const Eigen::Matrix2d mass = Eigen::Vector2d(m.m1, m.m2).asDiagonal();
  const double weight = glm::dot(m.gravity, m.rest);
  Linear s;
  s.M = to_positions.transpose() * mass * to_positions;
  s.D = m.drag * s.M;
  s.D(0, 0) += m.d1;
  s.D += m.d2 * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
  s.K = m.k2 * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
  s.K(0, 0) += m.k1 + (m.m1 + m.m2) * m.l1 * weight;
  s.K(1, 1) += m.m2 * m.l2 * weight;
  return s;
}

// Returns the strand `number`. With the dynamics of pressing(), it comes to rest on these stops:
// strand 0: Chain::limit_first
// strand 1: the skin below the joint, and the skin below the tip
// strand 2: Chain::limit_second
// strand 3: Chain::limit_first, and the skin below the tip
inline Chain pressed(int number) {
  Chain c;
  const float tilt = number == 1 || number == 3 ? glm::radians(60.0f) : 0.0f;
  c.rest = {std::sin(tilt), std::cos(tilt), 0};
  c.stiffness_first = number == 2 ? 60.0f : 20.0f;
  c.stiffness_second = 10;
  c.limit_first = number == 0 ? 20.0f : number == 3 ? 10.0f : 80.0f;
  c.limit_second = number == 2 ? 20.0f : 80.0f;
  return c;
}

inline ChainDynamics pressing(int number) {
  ChainDynamics s;
  if (number == 0 || number == 2) s.gravity = {9.81f, -2, 0};
  return s;
}

}  // namespace pelage::strands::reference
