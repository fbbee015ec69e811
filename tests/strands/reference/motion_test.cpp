// Tests properties of the motion that the reference for strands computes: equilibrium, convergence to the
// motion of two point masses, energy, stops (limits of angles, and the skin), and contact forces at rest.
#include <gtest/gtest.h>

#include "tests/strands/reference/two_masses.hpp"

namespace pelage::strands::reference {
namespace {

TEST(ChainReference, RestsWhereThePotentialEnergyIsStationary) {
  constexpr double limit = 1e-3;  // 1/s^2; gravity and wind are above 10 / s^2
  Chain c = strand({0, 1, 0});
  c.stiffness_first = 80;
  c.stiffness_second = 40;
  const ChainDynamics s = windy(1.0f / 240);
  const Masses masses(c, s);
  State state = reference::at_rest(c);
  for (long i = 0; i < 2400; ++i) state = step(c, s, state, i);
  EXPECT_LT(glm::dot(state.u, Vec(c.rest)), 0.99) << "the forces bend the strand";
  EXPECT_GT(glm::distance(state.u, state.w), 0.05);
  for (const double slope : gradient(state, [&](const State& at) { return masses.potential(at); }))
    EXPECT_NEAR(slope, 0, limit);
}

// The time steps are powers of 2, so that all simulations end at exactly the same time. With half the time
// step, a first-order method has half the error. The test permits `ratio` times the error.
void expect_convergence(const Chain& c, ChainDynamics s, const State& start) {
  constexpr double until = 0.5, largest = 0.02, ratio = 0.6;
  const State expected = Masses(c, s).runge_kutta(start, until, 4096);
  double last = 0;
  for (const int steps : {256, 512, 1024}) {
    s.step = float(until / steps);
    State state = start;
    for (long i = 0; i < steps; ++i) {
      state = step(c, s, state, i);
      ASSERT_EQ(state.stop, (std::array<double, 4>{})) << "no stop acts";
    }
    const double error = glm::distance(state.u, expected.u) + glm::distance(state.w, expected.w);
    if (steps > 256) {
      EXPECT_LT(error, ratio * last) << steps;
    }
    last = error;
  }
  EXPECT_LT(last, largest);
  EXPECT_GT(glm::distance(expected.u, start.u), 10 * largest) << "the strand moves";
}

State swinging() {
  State s;
  s.u = glm::normalize(Vec(0.6, -1, 0.1));
  s.w = glm::normalize(Vec(-0.2, -1, 0.6));
  s.a = orthogonal({0.5, 0, 2}, s.u);
  s.b = orthogonal({-1, 0, -2.5}, s.w);
  return s;
}

TEST(ChainReference, AFreeChainFallsLikeTheDoubleSphericalPendulum) {
  Chain c = strand({0, -1, 0});
  c.length = 1;
  c.stiffness_first = c.stiffness_second = 0;
  ChainDynamics s = still(0);
  s.gravity = {0, -9.81f, 0};
  expect_convergence(c, s, swinging());
}

TEST(ChainReference, AllForcesTogetherConvergeToTheMotionOfTwoMasses) {
  Chain c = strand({0, -1, 0});
  c.length = 1;
  c.stiffness_first = 40;
  c.stiffness_second = 20;
  expect_convergence(c, windy(0), swinging());
}

TEST(ChainReference, EnergyNeverRises) {
  constexpr double limit = 1e-10;  // rounding; the energies are about 100
  std::mt19937 random(3);
  for (int number = 0; number < 4; ++number) {
    const Chain c = pressed(number);
    const ChainDynamics s = pressing(number);
    State state = reference::at_rest(c);
    state.a = random_state(random, state.u, 20).a;
    state.a = orthogonal(state.a, state.u);
    double last = energy(c, s, state, 0);
    for (long i = 0; i < 1000; ++i) {
      state = step(c, s, state, i);
      const double found = energy(c, s, state, 0);
      ASSERT_LE(found, last + limit) << number << " in step " << i;
      last = found;
    }
  }
}

TEST(ChainReference, DirectionsStayUnitVectorsWithinTheStops) {
  constexpr double limit = 1.001e-6;  // item 6 of "Time step" in docs/strands.md permits -1e-6
  constexpr double rounding = 1e-9;
  std::array<int, 4> acted{};
  for (int number = 0; number < 4; ++number) {
    const Chain c = pressed(number);
    ChainDynamics s = pressing(number);
    s.wind.speed = 3;
    s.wind.gust = 1;
    s.motion.axis = {1, 1, 0};
    s.motion.swing = 1;
    s.motion.swing_frequency = 1.5f;
    State state = reference::at_rest(c);
    for (long i = 0; i < 480; ++i) {
      state = step(c, s, state, i);
      for (const double gap : gaps(c, s, state, double(i + 1) * double(s.step)))
        ASSERT_GE(gap, -limit) << number << " in step " << i;
      for (std::size_t k = 0; k < 4; ++k) {
        ASSERT_GE(state.stop[k], 0);
        acted[k] += state.stop[k] > 0;
      }
      ASSERT_NEAR(glm::length(state.u), 1, rounding);
      ASSERT_NEAR(glm::length(state.w), 1, rounding);
      ASSERT_NEAR(glm::dot(state.u, state.a), 0, rounding);
      ASSERT_NEAR(glm::dot(state.w, state.b), 0, rounding);
    }
  }
  for (std::size_t k = 0; k < 4; ++k) EXPECT_GT(acted[k], 0) << "stop " << k;
}

// The gap of a stop is negative if the strand violates the stop's constraint. At rest, the contact force of a
// stop is its impulse divided by the time step. The gradient of the potential energy must equal the sum of
// the gradients of the gaps, each multiplied by the contact force of its stop.
TEST(ChainReference, AfterTenSecondsStopsCarryTheStrandAtRest) {
  constexpr double rate_limit = 1e-3;   // rad/s
  constexpr double force_limit = 0.05;  // 1/s^2; the forces on the stops are between 10 and 50 / s^2
  constexpr double gap_limit = 1e-5;
  const std::array<std::vector<std::size_t>, 4> loaded{{{0}, {1, 3}, {2}, {0, 3}}};
  for (int number = 0; number < 4; ++number) {
    const Chain c = pressed(number);
    const ChainDynamics s = pressing(number);
    const Masses masses(c, s);
    State state = reference::at_rest(c);
    state.a = orthogonal({0, 0, 5}, state.u);  // the strand also moves sideways
    for (long i = 0; i < 2400; ++i) state = step(c, s, state, i);
    EXPECT_LT(glm::length(state.a) + glm::length(state.b), rate_limit) << number;
    const std::array<double, 4> found = gaps(c, s, state, 0);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& stops = loaded[std::size_t(number)];
      const bool expected = std::find(stops.begin(), stops.end(), k) != stops.end();
      EXPECT_EQ(state.stop[k] > 0, expected) << number << ", stop " << k;
      if (expected) {
        EXPECT_NEAR(found[k], 0, gap_limit) << number << ", stop " << k;
      }
    }
    const auto lagrangian = [&](const State& at) {
      const std::array<double, 4> gap = gaps(c, s, at, 0);
      double value = masses.potential(at);
      for (std::size_t k = 0; k < 4; ++k) value -= state.stop[k] / double(s.step) * gap[k];
      return value;
    };
    for (const double slope : gradient(state, lagrangian)) EXPECT_NEAR(slope, 0, force_limit) << number;
  }
}

TEST(ChainReference, AStrandWithoutForcesKeepsItsRestDirection) {
  constexpr double rounding = 1e-12;
  const Chain c = strand({0.6f, 0.8f, 0});
  const ChainDynamics s = still(1.0f / 240);
  State state = reference::at_rest(c);
  EXPECT_NEAR(glm::distance(state.u, Vec(0.6, 0.8, 0)), 0, 1e-6);
  EXPECT_EQ(state.u, state.w);
  const State start = state;
  for (long i = 0; i < 100; ++i) state = step(c, s, state, i);
  EXPECT_LT(glm::distance(state.u, start.u) + glm::distance(state.w, start.w), rounding);
}

}  // namespace
}  // namespace pelage::strands::reference
