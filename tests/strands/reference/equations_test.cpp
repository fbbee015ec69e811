// Tests the equations of the reference for the simulation of strands against the formulation of
// two_masses.hpp. A wrong term in an equation of docs/strands.md makes the two formulations differ.
#include <gtest/gtest.h>

#include "tests/strands/reference/two_masses.hpp"

namespace pelage::strands::reference {
namespace {

TEST(ChainReference, EnergyIsThatOfTwoMasses) {
  constexpr double limit = 1e-10;  // rounding; the energies are below 1000
  std::mt19937 random(1);
  const Chain c = strand({0, 1, 0});
  const ChainDynamics s = windy(1e-3f);
  const Masses masses(c, s);
  for (int i = 0; i < 10; ++i) {
    const State state = random_state(random, c.rest, 5);
    EXPECT_NEAR(energy(c, s, state, 0.3), masses.potential(state) + masses.kinetic(state), limit);
  }
}

// Without stiffness (k1 = k2 = 0), the potential energy is -Gu . u - Gw . w. The test computes each component
// of Gu and of Gw from the energies for two opposite directions. It computes the velocity and the
// acceleration of the root by finite differences of the root's position.
TEST(ChainReference, ForcesFollowTheMovingRoot) {
  constexpr double limit = 1e-5, delta = 1e-4;
  constexpr double tau = 2 * std::numbers::pi, time = 0.37;
  Chain c = strand({0, 1, 0});
  c.stiffness_first = c.stiffness_second = 0;
  c.root = {0.3f, -0.5f, 0.7f};
  ChainDynamics s = windy(1e-3f);
  s.wind.gust = 0.6f;
  s.wind.frequency = 1.5f;
  s.wind.wavelength = 0.8f;
  springs::Motion& m = s.motion;
  m.velocity = {0.1f, 0.4f, -0.2f};
  m.shake = {0.2f, 0, 0.1f};
  m.shake_frequency = 0.7f;
  m.axis = {1, 2, -1};
  m.spin = 1.5f;
  m.swing = 0.5f;
  m.swing_frequency = 0.9f;
  const auto root = [&](double t) {
    const double angle = double(m.spin) * t + double(m.swing) * std::sin(tau * double(m.swing_frequency) * t);
    return Vec(m.velocity) * t + Vec(m.shake) * (1 - std::cos(tau * double(m.shake_frequency) * t)) +
           springs::turned(Vec(c.root), glm::normalize(Vec(m.axis)), angle);
  };
  const Vec velocity = (root(time + delta) - root(time - delta)) / (2 * delta);
  const Vec acceleration = (root(time + delta) - 2.0 * root(time) + root(time - delta)) / (delta * delta);
  const Vec along = glm::normalize(Vec(s.wind.direction));
  const double cycles = double(s.wind.frequency) * time - glm::dot(Vec(c.root), along) / 0.8;
  const Vec air = 2 * (1 + 0.6 * std::sin(tau * cycles)) * along;
  const Masses masses(c, s);
  const Vec pull = (Vec(s.gravity) - acceleration + masses.drag * (air - velocity)) / double(c.length);
  for (int axis = 0; axis < 3; ++axis) {
    State plus, minus;
    plus.u[axis] = 1;
    minus.u[axis] = -1;
    const double gu = (energy(c, s, minus, time) - energy(c, s, plus, time)) / 2;
    EXPECT_NEAR(gu, masses.l1 * pull[axis], limit * glm::length(pull)) << axis;
    std::swap(plus.u, plus.w);
    std::swap(minus.u, minus.w);
    const double gw = (energy(c, s, minus, time) - energy(c, s, plus, time)) / 2;
    EXPECT_NEAR(gw, masses.m2 * masses.l2 * pull[axis], limit * glm::length(pull)) << axis;
  }
}

TEST(ChainReference, AShortStepHasTheAccelerationAndThePowerOfTwoMasses) {
  constexpr double limit = 2e-3;  // relative error; it is proportional to the time step, here 1e-6 s
  std::mt19937 random(2);
  const Chain c = strand({0, 1, 0});
  const ChainDynamics s = windy(1e-6f);
  const Masses masses(c, s);
  for (int i = 0; i < 10; ++i) {
    const State state = random_state(random, c.rest, 10), next = step(c, s, state, 0);
    const double h = double(s.step);
    const State expected = masses.derivative(state);
    EXPECT_LT(glm::length((next.u - state.u) / h - expected.u), limit * glm::length(expected.u));
    EXPECT_LT(glm::length((next.w - state.w) / h - expected.w), limit * glm::length(expected.w));
    EXPECT_LT(glm::length((next.a - state.a) / h - expected.a), limit * glm::length(expected.a));
    EXPECT_LT(glm::length((next.b - state.b) / h - expected.b), limit * glm::length(expected.b));
    const double power = (energy(c, s, next, h) - energy(c, s, state, h)) / h, loss = masses.loss(state);
    EXPECT_NEAR(power, -loss, 10 * limit * loss);
  }
}

TEST(ChainReference, BothModesHaveTheirFrequencies) {
  constexpr double limit = 1e-3, mixing = 1e-2, amplitude = 1e-4;
  const Chain c = strand({0, -1, 0});
  ChainDynamics s = still(1.0f / 4096);
  s.gravity = {0, -9.81f, 0};
  const Linear system = linear(Masses(c, s));
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> modes(system.K, system.M);
  const Vec tangent(0.6, 0, 0.8);
  for (int mode = 0; mode < 2; ++mode) {
    const auto coordinate = [&](const State& state, int k) {
      const Eigen::Vector2d offset(glm::dot(state.u, tangent), glm::dot(state.w, tangent));
      return modes.eigenvectors().col(k).dot(system.M * offset);
    };
    State state = reference::at_rest(c);
    state.u = glm::normalize(state.u + amplitude * modes.eigenvectors()(0, mode) * tangent);
    state.w = glm::normalize(state.w + amplitude * modes.eigenvectors()(1, mode) * tangent);
    std::vector<double> zeros;  // times at which the mode's coordinate changes its sign
    const double h = double(s.step);
    for (long i = 0; double(i) * h < 0.5; ++i) {
      const State next = step(c, s, state, i);
      const double from = coordinate(state, mode), to = coordinate(next, mode);
      if (from * to < 0) zeros.push_back((double(i) + from / (from - to)) * h);
      EXPECT_LT(std::abs(coordinate(next, 1 - mode)), mixing * amplitude);
      state = next;
    }
    ASSERT_GE(zeros.size(), 4u);
    const double frequency = std::numbers::pi * double(zeros.size() - 1) / (zeros.back() - zeros.front());
    const double expected = std::sqrt(modes.eigenvalues()[mode]);
    EXPECT_NEAR(frequency, expected, limit * expected) << mode;
  }
}

// For small displacements, a time step must equal a step of the theta method for M x'' + D x' + K x = 0. If a
// stop (a limit of an angle, or the skin) had an impulse in the previous step, theta is 1. With the time step
// h = 1/240 s, the terms in h^2 are large.
TEST(ChainReference, OneStepIsTheThetaMethod) {
  constexpr double limit = 1e-5;
  const Chain c = strand({0, -1, 0});
  ChainDynamics s = windy(1.0f / 240);
  s.wind.speed = 0;
  s.gravity = {0, -9.81f, 0};
  const Linear system = linear(Masses(c, s));
  const double h = double(s.step), x = h * h * (800 + 400), A = system.M(0, 0);
  const Vec tangent(0.6, 0, 0.8);
  const Eigen::Vector2d place(1e-4, -2e-4), rate(3e-2, 2e-2);
  for (const bool held : {false, true}) {
    State state = reference::at_rest(c);
    state.u = glm::normalize(state.u + place[0] * tangent);
    state.w = glm::normalize(state.w + place[1] * tangent);
    state.a = orthogonal(rate[0] * tangent, state.u);
    state.b = orthogonal(rate[1] * tangent, state.w);
    state.stop[0] = held ? 1e-9 : 0;
    const double theta = held ? 1 : (A / 2 + x) / (A + x), eta = theta * h;
    const Eigen::Matrix2d left = system.M + eta * system.D + eta * eta * system.K;
    const Eigen::Vector2d V = left.inverse() * (system.M * rate - eta * system.K * place);
    const Eigen::Vector2d new_place = place + h * V, new_rate = rate + (V - rate) / theta;
    const State next = step(c, s, state, 0);
    EXPECT_NEAR(glm::dot(next.u, tangent), new_place[0], limit * place.norm()) << held;
    EXPECT_NEAR(glm::dot(next.w, tangent), new_place[1], limit * place.norm()) << held;
    EXPECT_NEAR(glm::dot(next.a, tangent), new_rate[0], limit * rate.norm()) << held;
    EXPECT_NEAR(glm::dot(next.b, tangent), new_rate[1], limit * rate.norm()) << held;
    EXPECT_EQ(next.stop, (std::array<double, 4>{})) << "the stops are far away";
  }
}

}  // namespace
}  // namespace pelage::strands::reference
