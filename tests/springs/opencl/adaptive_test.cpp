// Tests mass-spring simulations with adaptive time steps. The result must be close to a solution with short
// time steps. The simulation must take many steps if the springs are stiff, and few steps if the system is at
// rest.
#include "harness/springs/opencl/adaptive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "harness/error.hpp"
#include "harness/springs/reference/reference.hpp"
#include "tests/springs/support/device.hpp"
#include "tests/springs/support/meshes.hpp"
#include "tests/springs/support/scenes.hpp"

namespace pelage::springs {
namespace {

using namespace test;

constexpr float span = 1.0f / 60;

std::vector<glm::dvec3> truth(const SpringNetwork& topology, Dynamics dynamics, int frames) {
  dynamics.solver = Solver::rk4;
  dynamics.step = span / 64;
  const reference::State rest = reference::rest(topology);
  return reference::offsets(topology, reference::after({topology, dynamics}, rest, 0, 64L * frames));
}

TEST(AdaptiveSteps, StayNearTheFineSolutionAsTheToleranceAsks) {
  const SpringNetwork topology = build(Kind::sticks, square(2), fur_length);
  for (const Solver solver : solvers) {
    Dynamics d = lively(solver);
    const auto fine = truth(topology, d, 30);
    double before = 1e9;
    for (const float tolerance : {1e-2f, 1e-3f, 1e-4f}) {
      MassSprings masses(queue(), topology, d);
      AdaptiveSteps steps(span, 1, tolerance);
      long all = 0;
      for (int i = 0; i < 30; ++i) {
        const AdaptiveSteps::Frame frame = steps.advance(queue(), masses);
        EXPECT_LE(frame.error, double(tolerance));
        all += frame.steps;
      }
      const double error = largest_difference(masses.offsets(queue()), fine) / double(fur_length);
      std::printf("%s, tolerance %g: %ld steps in 30 frames, error %.2g\n", name(solver).data(),
                  double(tolerance), all, error);
      // The springs are damped, so the errors of early frames decay. The error after 30 frames therefore
      // stays within a small multiple of the tolerance.
      EXPECT_LT(error, 20 * double(tolerance)) << name(solver);
      EXPECT_LE(error, 1.01 * before) << name(solver);
      before = std::max(error, 1e-6);
    }
  }
}

TEST(AdaptiveSteps, AreMoreWhereSpringsAreStiffAndFewWhereNothingMoves) {
  const SpringNetwork topology = build(Kind::separable_prisms, square(1), fur_length);
  const auto last = [&](const Dynamics& d) {
    MassSprings masses(queue(), topology, d);
    AdaptiveSteps steps(span, 4, 1e-2f);
    int found = 0;
    for (int i = 0; i < 10; ++i) found = steps.advance(queue(), masses).steps;
    return found;
  };
  Dynamics stiff = lively(Solver::explicit_euler);
  stiff.stiffness = 1000;  // explicit Euler then diverges with steps of 0.1 ms (167 per frame)
  const int soft = last(lively(Solver::explicit_euler)), many = last(stiff);
  EXPECT_GT(many, 2 * soft);
  EXPECT_GT(many, 150);
  EXPECT_EQ(last(still(Solver::explicit_euler)), 2);
}

// At least 99% of the top masses must meet the error tolerance. If 5 of the 162 top masses move (3%), the
// number of steps is larger than at rest. If only one top mass moves (0.6%), the number of steps is the same
// as at rest.
TEST(AdaptiveSteps, AreMoreWhereFewOfManyMove) {
  const SpringNetwork topology = build(Kind::sticks, sphere(2), fur_length);
  ASSERT_EQ(topology.sticks(), 162u);
  const auto first = [&](std::size_t poked) {
    MassSprings masses(queue(), topology, still(Solver::explicit_euler));
    std::vector<glm::vec3> push(topology.sticks(), glm::vec3(0));
    for (std::size_t i = 0; i < poked; ++i) push[i * 30] = {0.02f, 0.01f, 0};
    masses.push(queue(), push);
    return AdaptiveSteps(span, 1, 1e-3f).advance(queue(), masses).steps;
  };
  EXPECT_EQ(first(0), 2);
  EXPECT_EQ(first(1), 2);
  EXPECT_GE(first(5), 8);
}

TEST(AdaptiveSteps, SayWhenTheMostAreTooFew) {
  const SpringNetwork topology = build(Kind::sticks, square(1), fur_length);
  MassSprings masses(queue(), topology, lively(Solver::explicit_euler));
  EXPECT_THROW(AdaptiveSteps(span, 1, 1e-7f, 64).advance(queue(), masses), InputError);
  Dynamics stiff = lively(Solver::explicit_euler);
  stiff.stiffness = 1e5f;
  MassSprings lost(queue(), topology, stiff);
  EXPECT_THROW(AdaptiveSteps(1, 1, 1e-2f, 64).advance(queue(), lost), Diverged);
  for (const auto& [length, steps, tolerance, most] :
       {std::tuple(0.0f, 1, 1e-2f, 64), std::tuple(span, 0, 1e-2f, 64), std::tuple(span, 1, 0.0f, 64),
        std::tuple(span, 65, 1e-2f, 64), std::tuple(span, 1, std::numeric_limits<float>::quiet_NaN(), 64)})
    EXPECT_THROW(AdaptiveSteps(length, steps, tolerance, most), InputError);
}

}  // namespace
}  // namespace pelage::springs
