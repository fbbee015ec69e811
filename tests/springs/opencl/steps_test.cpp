// Compares every solver on every topology with the independent reference. The kernels compiled in double
// precision must agree with the reference up to the rounding of their float inputs. The device must agree
// with the reference to 1e-4 of the fur's length.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "harness/compare/checks.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "harness/springs/opencl/mass_springs.hpp"
#include "harness/springs/reference/reference.hpp"
#include "tests/springs/opencl/shim.hpp"
#include "tests/springs/support/differences.hpp"
#include "tests/springs/support/scenes.hpp"

namespace pelage::springs {
namespace {

using namespace test;
using Whole = MassSpringOptions::Whole;

struct Steps : testing::TestWithParam<Case> {};

TEST_P(Steps, AreTheReferencesAfterASecondOfWind) {
  const auto& [kind, solver] = GetParam();
  const Dynamics dynamics = lively(solver);
  const int steps = int(std::lround(1 / dynamics.step));
  for (const Mesh& mesh : {square(1), square(2), sphere(1)}) {  // with 5, 13 and 42 points
    const SpringNetwork network = build(kind, mesh, fur_length);
    reference::System system{network, dynamics};
    system.push.assign(network.sticks(), glm::dvec3(0));
    const std::vector<glm::vec3> force = poke(network, 1, {0.004f, -0.01f, 0.006f});
    for (std::size_t i = 0; i < force.size(); ++i) system.push[i] = glm::dvec3(force[i]);
    const reference::State rest = reference::rest(network);
    const auto offsets = reference::offsets(network, reference::after(system, rest, 0, steps));
    EXPECT_GT(largest_difference(reference::offsets(network, rest), offsets), 0.01) << "something moved";

    // Prisms have two sets of kernels: one for many work-items and one for a single work-item.
    std::vector<Whole> mappings{Whole::never};
    if (kind == Kind::prisms) mappings.push_back(Whole::always);
    for (const Whole whole : mappings) {
      Shim shim(network, dynamics);
      shim.push(force);
      for (int done = 0; done < steps; done += 50)
        shim.advance(std::min(50, steps - done), whole == Whole::always);
      // Shim runs the kernels in double precision, but gravity, wind, 1/m and the unit normals are rounded to
      // floats. The tolerance permits the effect of this rounding.
      EXPECT_LT(largest_difference(shim.offsets(), offsets), tolerance::float_records * double(fur_length));

      MassSprings device(queue(), network, dynamics, {.whole = whole});
      device.push(queue(), force);
      for (int done = 0; done < steps; done += 50) device.advance(queue(), std::min(50, steps - done));
      EXPECT_LT(largest_difference(device.offsets(queue()), offsets),
                tolerance::stick_top * double(fur_length));
      std::printf("%zu sticks: kernels in double %.2g, device %.2g of the fur's length\n", network.sticks(),
                  largest_difference(shim.offsets(), offsets) / double(fur_length),
                  largest_difference(device.offsets(queue()), offsets) / double(fur_length));
    }
  }
}

// Tests an irregular mesh: an elephant with as many triangles as in Banisch and Wuethrich (2006). On prisms,
// compressed springs between tops may buckle in a direction that depends on rounding, so a few tops may have
// large errors, and the test limits the rms and the 99th percentile of the errors.
TEST(StepsOnTheElephant, AreTheReferencesAfterASecondOfWind) {
  const auto mesh = load_model("banisch-elephant");
  for (const Kind kind : {Kind::prisms, Kind::separable_prisms})
    for (const Solver solver : solvers) {
      const Dynamics dynamics = lively(solver);
      const int steps = int(std::lround(1 / dynamics.step));
      const SpringNetwork network = build(kind, *mesh, fur_length);
      const reference::State end = reference::after({network, dynamics}, reference::rest(network), 0, steps);
      const std::vector<glm::dvec3> offsets = reference::offsets(network, end);
      MassSprings device(queue(), network, dynamics);
      device.advance(queue(), steps);
      const Spread error =
          spread(device.offsets(queue()), {offsets.begin(), offsets.end()}, double(fur_length));
      std::printf(
          "%s %s: rms %.2g, 99%% %.2g, worst %.2g of the fur's length; %ld iterations in %ld solves\n",
          kind.name.data(), solver.name.data(), error.rms, error.percentile_99, error.worst,
          device.solves().iterations, device.solves().solves);
      if (kind == Kind::prisms) {
        EXPECT_LT(error.rms, tolerance::prisms_rms) << solver.name;
        EXPECT_LT(error.percentile_99, tolerance::prisms_p99) << solver.name;
      } else {
        EXPECT_LT(error.worst, tolerance::stick_top) << solver.name;
      }
    }
}

// Returns dynamics for the tests of the residual. `stiffness` is the stiffness of the springs between tops in
// N/m, and `share` a factor of the mass and of all constants of a stick.
Dynamics stiff(float stiffness, float step, float asked, float share = 1) {
  Dynamics d = lively(Solver::backward_euler);
  d.residual = asked;
  d.edge_stiffness = stiffness;
  d.step = step;
  for (float* constant : {&d.mass, &d.stiffness, &d.damping, &d.drag, &d.return_weight}) *constant *= share;
  return d;
}

// Returns the relative residual |b - A x| / |b| of one backward Euler step from rest, computed in double
// precision. The solution x is the change of the velocities. Because the step starts from rest, x is equal to
// the new velocities. The test can therefore read x from the device without an additional rounding error.
double residual_left(const SpringNetwork& network, const Dynamics& dynamics, Whole whole) {
  MassSprings device(queue(), network, dynamics, {.whole = whole});
  device.advance(queue(), 1);
  const std::vector<glm::vec3> speeds = device.speeds(queue());
  const std::vector<glm::dvec3> change(speeds.begin(), speeds.end());
  const double left = reference::residual({network, dynamics}, reference::rest(network), 0, change);
  std::printf(
      "k = %g, m = %g g, dt = %.4f, asked %.0e: %.2e left, %.2e by its own reckoning, %ld iterations\n",
      double(dynamics.edge_stiffness), 1e3 * double(dynamics.mass), double(dynamics.step),
      double(dynamics.residual), left, device.solves().worst_residual, device.solves().iterations);
  return left;
}

TEST(StepsOnTheElephant, ConjugateGradientsLeaveTheResidualThatIsAskedFor) {
  const SpringNetwork network = build(Kind::prisms, *load_model("banisch-elephant"), fur_length);
  for (const Whole whole : {Whole::never, Whole::always}) {
    for (const float asked : {1e-2f, 1e-3f, 1e-4f})
      EXPECT_LT(residual_left(network, stiff(20, 1.0f / 60, asked), whole), 1.05 * double(asked));
    EXPECT_LT(residual_left(network, stiff(2, 1.0f / 240, 1e-5f), whole), 1.05e-5);
    // A residual of 1e-7 cannot be reached, because the vectors from the bases to the tops are floats. Their
    // rounding error is up to 2e-9 R at a length of 0.05 R. The forces of the springs between tops at rest
    // therefore have an error, which is the stiffness times this error. The right-hand side b contains the
    // forces multiplied by the time step, so b has an error, too.
    EXPECT_LT(residual_left(network, stiff(20, 1.0f / 60, 1e-7f), whole), 3e-5);
  }
}

// If the masses are light and the springs between tops are stiff, rounding errors of the spring forces are
// large compared to the weight of the masses. The forces must therefore not be computed from positions that
// are rounded to floats: such positions have an error of 6e-8 R. The test computes an exact solution for
// rounded positions and checks that its residual exceeds the limit, so that a solver with this mistake would
// fail. The mesh is fine, because the rounding error of the kernels' springs is proportional to their
// lengths.
TEST(StepsOnAFineSphere, LightMassesBetweenStiffSpringsKeepTheLimitOfTheResidual) {
  const SpringNetwork network = build(Kind::prisms, sphere(5), fur_length);
  const Dynamics dynamics = stiff(20, 1.0f / 60, 1e-5f, 0.01f);
  const reference::System system{network, dynamics};
  reference::State rounded = reference::rest(network);
  for (glm::dvec3& position : rounded.position) position = glm::dvec3(glm::vec3(position));
  std::vector<glm::dvec3> change = reference::step(system, rounded, 0).velocity;
  change.erase(change.begin(), change.begin() + std::ptrdiff_t(network.sticks()));
  const double wrong = reference::residual(system, reference::rest(network), 0, change);
  std::printf("%zu sticks: %.2e left by the exact solution for rounded positions\n", network.sticks(), wrong);
  EXPECT_GT(wrong, 2 * tolerance::step_residual);
  for (const Whole whole : {Whole::never, Whole::always})
    EXPECT_LT(residual_left(network, dynamics, whole), tolerance::step_residual);
}

INSTANTIATE_TEST_SUITE_P(All, Steps, testing::Combine(testing::ValuesIn(kinds), testing::ValuesIn(solvers)),
                         pelage::test::by_parameter);

// Tests the backward Euler step of the kernels, which solves a linear system for the change of the
// velocities. The test computes the matrix of this system by finite differences of the reference's forces,
// without the reference's formulas of the derivatives.
using Whole = MassSpringOptions::Whole;

struct KernelStep : testing::TestWithParam<Kind> {};

TEST_P(KernelStep, SolvesTheSystemOfFiniteDifferences) {
  const SpringNetwork network = build(GetParam(), sphere(0), fur_length);
  const Dynamics d = stiff_step();
  const reference::State state = stretched(network);
  const Step step = step_by_differences({network, d}, state, 0);
  const std::vector<glm::dvec3> offsets = reference::offsets(network, state),
                                before = speeds_of(network, state);
  for (const bool whole : {false, true}) {
    if (whole && !GetParam().shared_edges()) continue;
    Shim shim(network, d);
    shim.set(offsets, before);
    shim.advance(1, whole);
    // The kernels read normals, wind and weight as floats, so the tolerance is that of single precision.
    EXPECT_LT(residual_of(step, before, shim.speeds()), tolerance::float_records) << whole;

    MassSprings device(queue(), network, d, {.whole = whole ? Whole::always : Whole::never});
    device.set(queue(), {offsets.begin(), offsets.end()}, {before.begin(), before.end()});
    device.advance(queue(), 1);
    const auto speeds = device.speeds(queue());
    EXPECT_LT(residual_of(step, before, {speeds.begin(), speeds.end()}), tolerance::step_residual) << whole;
  }
}

// Tests a step with all terms of the derivatives. The object rotates, and some springs are stretched, others
// compressed.
TEST_P(KernelStep, WithTheFullJacobianIsThatOfTheReferenceOnly) {
  const SpringNetwork network = build(GetParam(), sphere(0), fur_length);
  Dynamics d = lively(Solver::backward_euler);
  d.step = 1.0f / 60;
  d.edge_damping = 0.05f;
  d.full_jacobian = true;
  EXPECT_THROW(MassSprings(queue(), network, d), InputError);
  for (const reference::State& state : {crumpled(network), stretched(network)}) {
    const Step step = full_step_by_differences({network, d}, state, 0);
    const reference::State next = reference::step({network, d}, state, 0);
    EXPECT_LT(residual_of(step, speeds_of(network, state), speeds_of(network, next)),
              tolerance::float_records);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, KernelStep, testing::ValuesIn(kinds), pelage::test::by_parameter);

// Tests mass-spring simulations with adaptive time steps. The result must be close to a solution with short
// time steps. The simulation must take many steps if the springs are stiff, and few steps if the system is at
// rest.

constexpr float span = 1.0f / 60;

std::vector<glm::dvec3> truth(const SpringNetwork& network, Dynamics dynamics, int frames) {
  dynamics.solver = Solver::rk4;
  dynamics.step = span / 64;
  const reference::State rest = reference::rest(network);
  return reference::offsets(network, reference::after({network, dynamics}, rest, 0, 64L * frames));
}

TEST(AdaptiveSteps, StayNearTheFineSolutionAsTheToleranceAsks) {
  const SpringNetwork network = build(Kind::sticks, square(2), fur_length);
  for (const Solver solver : solvers) {
    Dynamics d = lively(solver);
    const auto fine = truth(network, d, 30);
    double before = 1e9;
    for (const float tolerance : {1e-2f, 1e-3f, 1e-4f}) {
      MassSprings masses(queue(), network, d);
      AdaptiveSteps steps(span, 1, tolerance);
      long all = 0;
      for (int i = 0; i < 30; ++i) {
        const AdaptiveSteps::Frame frame = steps.advance(queue(), masses);
        EXPECT_LE(frame.error, double(tolerance));
        all += frame.steps;
      }
      const double error = largest_difference(masses.offsets(queue()), fine) / double(fur_length);
      std::printf("%s, tolerance %g: %ld steps in 30 frames, error %.2g\n", solver.name.data(),
                  double(tolerance), all, error);
      // The springs are damped, so the errors of early frames decay. The error after 30 frames therefore
      // stays within a small multiple of the tolerance.
      EXPECT_LT(error, 20 * double(tolerance)) << solver.name;
      EXPECT_LE(error, 1.01 * before) << solver.name;
      before = std::max(error, 1e-6);
    }
  }
}

TEST(AdaptiveSteps, AreMoreWhereSpringsAreStiffAndFewWhereNothingMoves) {
  const SpringNetwork network = build(Kind::separable_prisms, square(1), fur_length);
  const auto last = [&](const Dynamics& d) {
    MassSprings masses(queue(), network, d);
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
  const SpringNetwork network = build(Kind::sticks, sphere(2), fur_length);
  ASSERT_EQ(network.sticks(), 162u);
  const auto first = [&](std::size_t poked) {
    MassSprings masses(queue(), network, still(Solver::explicit_euler));
    std::vector<glm::vec3> push(network.sticks(), glm::vec3(0));
    for (std::size_t i = 0; i < poked; ++i) push[i * 30] = {0.02f, 0.01f, 0};
    masses.push(queue(), push);
    return AdaptiveSteps(span, 1, 1e-3f).advance(queue(), masses).steps;
  };
  EXPECT_EQ(first(0), 2);
  EXPECT_EQ(first(1), 2);
  EXPECT_GE(first(5), 8);
}

TEST(AdaptiveSteps, SayWhenTheMostAreTooFew) {
  const SpringNetwork network = build(Kind::sticks, square(1), fur_length);
  MassSprings masses(queue(), network, lively(Solver::explicit_euler));
  EXPECT_THROW(AdaptiveSteps(span, 1, 1e-7f, 64).advance(queue(), masses), InputError);
  Dynamics stiff = lively(Solver::explicit_euler);
  stiff.stiffness = 1e5f;
  MassSprings lost(queue(), network, stiff);
  EXPECT_THROW(AdaptiveSteps(1, 1, 1e-2f, 64).advance(queue(), lost), Diverged);
  for (const auto& [length, steps, tolerance, most] :
       {std::tuple(0.0f, 1, 1e-2f, 64), std::tuple(span, 0, 1e-2f, 64), std::tuple(span, 1, 0.0f, 64),
        std::tuple(span, 65, 1e-2f, 64), std::tuple(span, 1, std::numeric_limits<float>::quiet_NaN(), 64)})
    EXPECT_THROW(AdaptiveSteps(length, steps, tolerance, most), InputError);
}

}  // namespace
}  // namespace pelage::springs
