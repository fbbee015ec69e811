// Tests that every baseline solves the same equations as the reference. Otherwise its times could not be
// compared with those of the OpenCL solvers.
#include "harness/springs/baselines/baselines.hpp"

#include <gtest/gtest.h>

#include "harness/compare/tolerances.hpp"
#include "harness/springs/reference/reference.hpp"
#include "tests/springs/support/differences.hpp"
#include "tests/springs/support/scenes.hpp"

namespace pelage::springs {
namespace {

using namespace test;

struct Baselines : testing::TestWithParam<Case> {};

// Tests objects at rest and rotating objects, with meshes of 4, 16 and 320 triangles. The serial baselines
// process blocks of 256 triangles or sticks; a mesh of 320 triangles needs more than one block.
TEST_P(Baselines, AreTheReferenceAfterASecondOfWind) {
  const auto& [kind, solver] = GetParam();
  for (const bool turning : {false, true})
    for (const Mesh& mesh : {square(1), square(2), sphere(2)}) {
      Dynamics dynamics = lively(solver);
      if (!turning) dynamics.motion = {};
      dynamics.residual = 1e-6f;
      const int steps = int(std::lround((turning ? 0.25 : 1) / double(dynamics.step)));
      const SpringNetwork network = build(kind, mesh, fur_length);
      const reference::System system{network, dynamics};
      const reference::State rest = reference::rest(network);
      Motions start;
      for (const glm::dvec3& q : reference::offsets(network, rest)) {
        start.offset.emplace_back(q);
        start.speed.emplace_back(0.0f);
      }
      const auto offsets = reference::offsets(network, reference::after(system, rest, 0, steps));

      const auto baselines = solver_baselines(network, dynamics);
      EXPECT_GE(baselines.size(), 2u);
      for (const auto& [name, baseline, threads] : baselines) {
        baseline->set(start);
        for (int done = 0; done < steps; done += 40) {
          const int count = std::min(40, steps - done);
          baseline->advance(moments(dynamics, done, count), count);
        }
        const double error = largest_difference(baseline->state().offset, offsets) / double(fur_length);
        // Baselines in double precision still read some inputs and the initial state as floats. All other
        // baselines also compute in floats and have a larger limit.
        EXPECT_LT(error, name.find("double") != std::string::npos ? tolerance::double_baseline
                                                                  : tolerance::stick_top)
            << name << ", " << network.sticks() << " sticks";
        baseline->set(start);
        EXPECT_EQ(baseline->state().offset, start.offset) << name;
      }
    }
}

INSTANTIATE_TEST_SUITE_P(All, Baselines,
                         testing::Combine(testing::ValuesIn(kinds), testing::ValuesIn(solvers)),
                         pelage::test::by_parameter);

// Tests the backward Euler step of every baseline, which solves a linear system for the change of the
// velocities. The test computes the matrix of this system by finite differences of the reference's forces.

TEST(BaselineStep, SolvesTheSystemOfFiniteDifferences) {
  const Dynamics d = stiff_step();
  for (const Kind& kind : kinds) {
    const SpringNetwork network = build(kind, sphere(0), fur_length);
    const reference::State state = stretched(network);
    const Step step = step_by_differences({network, d}, state, 0);
    const std::vector<glm::dvec3> offsets = reference::offsets(network, state),
                                  before = speeds_of(network, state);
    const Motions start{{offsets.begin(), offsets.end()}, {before.begin(), before.end()}};
    const auto baselines = solver_baselines(network, d);
    EXPECT_GE(baselines.size(), 2u) << kind;
    for (const auto& [name, baseline, threads] : baselines) {
      baseline->set(start);
      baseline->advance(moments(d, 0, 1), 1);
      const auto speeds = baseline->state().speed;
      EXPECT_LT(residual_of(step, before, {speeds.begin(), speeds.end()}), tolerance::step_residual)
          << kind << ' ' << name;
    }
  }
}

}  // namespace
}  // namespace pelage::springs
