// Tests the reference in two ways. Its motion, computed in the object's frame, must equal a motion that the
// test computes in the world frame. Its integration schemes must agree with closed-form solutions.
#include "harness/springs/reference/reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>

#include "harness/compare/tolerances.hpp"
#include "tests/springs/support/differences.hpp"
#include "tests/springs/support/scenes.hpp"

namespace pelage::springs {
namespace {

using namespace test;

struct Pose {
  glm::dvec3 shift;
  glm::dmat3 turn;
};

Pose pose(const Motion& m, double t) {
  const double tau = 2 * std::numbers::pi;
  const double angle = double(m.spin) * t + double(m.swing) * std::sin(tau * double(m.swing_frequency) * t);
  return {
      glm::dvec3(m.velocity) * t + glm::dvec3(m.shake) * (1 - std::cos(tau * double(m.shake_frequency) * t)),
      glm::dmat3(glm::rotate(glm::dmat4(1), angle, glm::normalize(glm::dvec3(m.axis))))};
}

// Integrates Newton's law in the world frame by RK4. The bases move with the object. The forces on the top
// masses are those of springs, gravity, wind and drag, and the return force (Eq. 5 of Banisch and
// Wuethrich 2006). The world frame has no inertial forces.
std::vector<glm::dvec3> offsets_by_the_world(const SpringNetwork& network, const Dynamics& d, double until,
                                             int steps) {
  const double h = until / steps, tau = 2 * std::numbers::pi;
  const std::size_t sticks = network.sticks();
  std::vector<glm::dvec3> root, normal, top, speed;
  for (auto* values : {&root, &normal, &top, &speed}) values->reserve(sticks);
  const Pose start = pose(d.motion, 0), soon = pose(d.motion, 1e-6), before = pose(d.motion, -1e-6);
  for (std::size_t i = 0; i < sticks; ++i) {
    root.emplace_back(network.mass[i]);
    normal.emplace_back(network.normal[i]);
    const glm::dvec3 rest = root[i] + glm::dvec3(network.length * network.normal[i]);
    top.push_back(start.shift + start.turn * rest);
    speed.push_back(((soon.shift + soon.turn * rest) - (before.shift + before.turn * rest)) / 2e-6);
  }
  const glm::dvec3 blow = glm::normalize(glm::dvec3(d.wind.direction));
  const auto acceleration = [&](double t, const std::vector<glm::dvec3>& p,
                                const std::vector<glm::dvec3>& v) {
    const Pose at = pose(d.motion, t), next = pose(d.motion, t + 1e-6), last = pose(d.motion, t - 1e-6);
    std::vector<glm::dvec3> f(sticks);
    const auto spring = [&](glm::dvec3 from, glm::dvec3 to, glm::dvec3 from_v, glm::dvec3 to_v, double rest,
                            double k, double c) {
      const glm::dvec3 along = glm::normalize(to - from);
      return (k * (glm::distance(from, to) - rest) + c * glm::dot(to_v - from_v, along)) * along;
    };
    for (std::size_t i = 0; i < sticks; ++i) {
      const glm::dvec3 base = at.shift + at.turn * root[i];
      const glm::dvec3 base_v =
          ((next.shift + next.turn * root[i]) - (last.shift + last.turn * root[i])) / 2e-6;
      f[i] -=
          spring(base, p[i], base_v, v[i], double(network.length), double(d.stiffness), double(d.damping));
      const glm::dvec3 n = at.turn * normal[i], s = glm::normalize(p[i] - base);
      f[i] += (n - s) * (1 - glm::dot(n, s)) * double(d.return_weight);
      const double swell = std::sin(
          tau * (double(d.wind.frequency) * t - glm::dot(root[i], blow) / double(d.wind.wavelength)));
      f[i] += double(d.drag) * (double(d.wind.speed) * (1 + double(d.wind.gust) * swell) * blow - v[i]);
      f[i] += double(d.mass) * glm::dvec3(d.gravity);
    }
    for (std::size_t k = sticks; k < network.spring.size(); ++k) {
      const std::size_t a = network.spring[k].x - sticks, b = network.spring[k].y - sticks;
      const glm::dvec3 pull = spring(p[a], p[b], v[a], v[b], double(network.rest[k]),
                                     double(d.edge_stiffness), double(d.edge_damping));
      f[a] += pull;
      f[b] -= pull;
    }
    for (glm::dvec3& force : f) force /= double(d.mass);
    return f;
  };
  const auto plus = [](std::vector<glm::dvec3> x, double time, const std::vector<glm::dvec3>& rate) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += time * rate[i];
    return x;
  };
  for (int i = 0; i < steps; ++i) {
    const double t = i * h;
    const auto a1 = acceleration(t, top, speed), v2 = plus(speed, h / 2, a1);
    const auto a2 = acceleration(t + h / 2, plus(top, h / 2, speed), v2), v3 = plus(speed, h / 2, a2);
    const auto a3 = acceleration(t + h / 2, plus(top, h / 2, v2), v3), v4 = plus(speed, h, a3);
    const auto a4 = acceleration(t + h, plus(top, h, v3), v4);
    top = plus(plus(plus(plus(top, h / 6, speed), h / 3, v2), h / 3, v3), h / 6, v4);
    speed = plus(plus(plus(plus(speed, h / 6, a1), h / 3, a2), h / 3, a3), h / 6, a4);
  }
  const Pose end = pose(d.motion, until);
  std::vector<glm::dvec3> q;
  q.reserve(sticks);
  for (std::size_t i = 0; i < sticks; ++i)
    q.push_back(glm::transpose(end.turn) * (top[i] - end.shift) - root[i]);
  return q;
}

TEST(ReferenceTopology, TheObjectsFrameIsTheWorldSeenFromIt) {
  for (const Kind kind : kinds) {
    const SpringNetwork network = build(kind, square(1), fur_length);
    Dynamics d = lively(Solver::rk4);
    d.step = 1e-3f;
    const double until = 400 * double(d.step);
    const reference::State rest = reference::rest(network);
    const auto q = reference::offsets(network, reference::after({network, d}, rest, 0, 400));
    const auto world = offsets_by_the_world(network, d, until, 1000);
    EXPECT_GT(largest_difference(q, reference::offsets(network, rest)), 0.2 * double(fur_length));
    EXPECT_LT(largest_difference(q, world), tolerance::reference_in_world * double(fur_length)) << kind;
  }
}

// The extension x of a stick that is stretched along its axis is a damped oscillation: m x'' + c x' + k x =
// 0, with the mass m, the damping c and the stiffness k.
TEST(ReferenceTopology, ASticksLengthIsADampedOscillation) {
  const SpringNetwork network = build(Kind::sticks, square(1), fur_length);
  Dynamics d = still(Solver::rk4);
  d.step = 1e-4f;
  reference::State state = reference::rest(network);
  const double start = 0.01;
  state.position[network.top(0)] += start * glm::dvec3(network.normal[0]);
  const double k = double(d.stiffness), c = double(d.damping), m = double(d.mass), decay = c / (2 * m),
               rate = std::sqrt(k / m - decay * decay);
  for (int i = 1; i <= 500; ++i) {
    state = reference::step({network, d}, state, i - 1);
    const double t = i * double(d.step);
    const double x = start * std::exp(-decay * t) * (std::cos(rate * t) + decay / rate * std::sin(rate * t));
    ASSERT_NEAR(glm::length(reference::offsets(network, state)[0]), double(fur_length) + x, 1e-8) << i;
  }
}

// Let x be the extension of a stick that is stretched along its axis, and v the rate of x. A step of length h
// changes v by dv. m is the mass, c the damping and k the stiffness. For this motion the linearised step of
// backward Euler is exact: (m + h c + h^2 k) dv = -h (k x + (c + h k) v).
TEST(ReferenceTopology, BackwardEulerOfAStraightPullIsItsClosedForm) {
  const SpringNetwork network = build(Kind::sticks, square(1), fur_length);
  Dynamics d = still(Solver::backward_euler);
  d.step = 1.0f / 60;
  reference::State state = reference::rest(network);
  double x = 0.01, v = 0;
  state.position[network.top(0)] += x * glm::dvec3(network.normal[0]);
  const double h = double(d.step), k = double(d.stiffness), c = double(d.damping), m = double(d.mass);
  for (int i = 0; i < 60; ++i) {
    state = reference::step({network, d}, state, i);
    v = (m * v - h * k * x) / (m + h * c + h * h * k);
    x += h * v;
    ASSERT_NEAR(glm::length(reference::offsets(network, state)[0]), double(fur_length) + x, 1e-9) << i;
  }
}

// Newton's third law: the spring forces on all masses, including the fixed ones, sum to 0.
TEST(ReferenceTopology, SpringsPushBothEnds) {
  const SpringNetwork network = build(Kind::prisms, sphere(1), fur_length);
  Dynamics d = still(Solver::explicit_euler);
  d.return_weight = 0;
  glm::dvec3 sum(0);
  double size = 0;
  for (const glm::dvec3& f : reference::forces({network, d}, crumpled(network), 0))
    sum += f, size += glm::length(f);
  EXPECT_GT(size, 1);
  EXPECT_LT(glm::length(sum), 1e-12 * size);
}

// The test computes the derivative of the total energy with respect to the positions by finite differences.
// The sum of the spring forces and gravity must be the negative of this derivative.
TEST(ReferenceTopology, ForcesAreTheGradientOfTheEnergy) {
  const SpringNetwork network = build(Kind::prisms, square(2), fur_length);
  Dynamics d = still(Solver::explicit_euler);
  d.return_weight = d.damping = d.edge_damping = 0;
  d.gravity = {1, -9.81f, 2};
  const reference::State state = crumpled(network);
  const reference::System system{network, d};
  const auto f = reference::forces(system, state, 0);
  for (std::size_t i = network.sticks(); i < state.position.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      reference::State up = state, down = state;
      up.position[i][c] += 1e-6;
      down.position[i][c] -= 1e-6;
      EXPECT_NEAR(f[i][c],
                  (reference::total_energy(system, down) - reference::total_energy(system, up)) / 2e-6, 1e-8);
    }
}

// Without friction, the total energy of fur that falls and swings under gravity is constant. With RK4 and
// short steps, it changes by less than 1e-4 of `unit`, the energy of a fall by the fur's length. energy(),
// which excludes the potential energy of gravity, changes by more than 1e-2 of `unit`.
TEST(ReferenceTopology, TotalEnergyIsKeptWithoutFriction) {
  for (const Kind kind : kinds) {
    const SpringNetwork network = build(kind, sphere(0), fur_length);
    Dynamics d = still(Solver::rk4);
    d.return_weight = d.damping = d.edge_damping = 0;
    d.gravity = {0, -9.81f, 0};
    d.step = 5e-4f;
    const reference::System system{network, d};
    reference::State state = reference::rest(network);
    const double unit = double(network.sticks()) * double(d.mass) * 9.81 * double(fur_length);
    const double total = reference::total_energy(system, state), own = reference::energy(system, state);
    state = reference::after(system, state, 0, 1000);
    EXPECT_LT(std::abs(reference::total_energy(system, state) - total), 1e-4 * unit) << kind;
    EXPECT_GT(std::abs(reference::energy(system, state) - own), 0.01 * unit) << kind;
  }
}

// Compares the reference's formulas for the derivatives of the forces with finite differences of the
// reference's forces.

Matrix matrix_of(const reference::Derivatives& found, bool by_velocity) {
  const auto size = Eigen::Index(found.size);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const Rows>((by_velocity ? found.by_velocity : found.by_position).data(), size, size);
}

struct Derivatives : testing::TestWithParam<Kind> {};

TEST_P(Derivatives, AllTermsAreTheFiniteDifferencesOfTheForces) {
  const SpringNetwork network = build(GetParam(), sphere(0), fur_length);
  Dynamics d = lively(Solver::backward_euler);  // the object rotates
  d.full_jacobian = true;
  d.edge_stiffness = 5;
  d.edge_damping = 0.05f;
  d.return_weight = 0.8f;
  for (const reference::State& state : {crumpled(network), stretched(network)})
    for (const bool by_velocity : {false, true}) {
      const reference::System system{network, d};
      const Matrix expected = differences(system, state, 0.37, by_velocity);
      const Matrix found = matrix_of(reference::derivatives(system, state, 0.37), by_velocity);
      EXPECT_LT((found - expected).norm(), 1e-7 * expected.norm()) << by_velocity;
      EXPECT_GT((found - found.transpose()).norm(), 1e-3 * expected.norm()) << "asymmetric";
    }
}

TEST_P(Derivatives, OfAPrunedStepAreTheFiniteDifferencesOnStretchedSprings) {
  const SpringNetwork network = build(GetParam(), sphere(0), fur_length);
  const Dynamics d = stiff_step();
  const reference::State state = stretched(network);
  for (std::size_t k = 0; k < network.spring.size(); ++k) {
    const glm::uvec2 ends = network.spring[k];
    ASSERT_GT(glm::distance(state.position[ends.x], state.position[ends.y]), double(network.rest[k]));
  }
  const reference::System system{network, d};
  const Step step = step_by_differences(system, state, 0);
  const reference::State next = reference::step(system, state, 0);
  EXPECT_LT(residual_of(step, speeds_of(network, state), speeds_of(network, next)), 1e-8);
  // By default, the reference omits some terms of the derivatives. The remaining derivatives with respect to
  // the positions form a symmetric matrix.
  const Matrix j = matrix_of(reference::derivatives(system, state, d.step), false);
  EXPECT_LT((j - j.transpose()).norm(), 1e-12 * j.norm());
}

// By default, the reference omits some terms of the derivatives (dynamics.springs.jacobian = "pruned"). If a
// stick is compressed, the derivative of its force must then contain only the stiffness along the stick.
TEST(DerivativesOfAStick, KeepOnlyTheForceAlongACompressedSpring) {
  const SpringNetwork network = build(Kind::sticks, square(1), fur_length);
  Dynamics d = still(Solver::backward_euler);
  d.return_weight = 0;
  reference::State state = reference::rest(network);
  for (std::size_t i = 0; i < network.sticks(); ++i)
    state.position[network.top(i)] = state.position[i] + glm::dvec3(0.01, 0.02 + 0.002 * double(i), -0.015);
  const reference::System system{network, d};
  const Matrix exact = differences(system, state, 0, false);
  const Matrix found = matrix_of(reference::derivatives(system, state, 0), false);
  for (std::size_t i = 0; i < network.sticks(); ++i) {
    const glm::dvec3 q = state.position[network.top(i)] - state.position[i];
    ASSERT_LT(glm::length(q), double(fur_length));
    const glm::dvec3 s = glm::normalize(q);
    const Eigen::Vector3d along(s.x, s.y, s.z);
    const Eigen::Matrix3d own = exact.block<3, 3>(Eigen::Index(3 * i), Eigen::Index(3 * i));
    const Eigen::Matrix3d kept = along * along.transpose() * own;
    EXPECT_LT((found.block<3, 3>(Eigen::Index(3 * i), Eigen::Index(3 * i)) - kept).norm(), 1e-7 * own.norm());
    EXPECT_GT((own - kept).norm(), 0.1 * own.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Derivatives, testing::ValuesIn(kinds), pelage::test::by_parameter);

}  // namespace
}  // namespace pelage::springs
