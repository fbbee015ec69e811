// Tests that every baseline solves the same equations as the reference. Otherwise its times could not be
// compared with those of the OpenCL solvers.
#include <gtest/gtest.h>

#include "harness/compare/tolerances.hpp"
#include "harness/springs/baselines/baselines.hpp"
#include "harness/springs/reference/reference.hpp"
#include "tests/springs/support/differences.hpp"
#include "tests/springs/support/scenes.hpp"

namespace pelage::springs {
namespace {

using namespace test;

struct Rivals : testing::TestWithParam<Case> {};

// Tests objects at rest and rotating objects, with meshes of 4, 16 and 320 triangles. The serial baselines
// process blocks of 256 triangles or sticks; a mesh of 320 triangles needs more than one block.
TEST_P(Rivals, AreTheReferenceAfterASecondOfWind) {
  const auto& [kind, solver] = GetParam();
  for (const bool turning : {false, true})
    for (const Mesh& mesh : {square(1), square(2), sphere(2)}) {
      Dynamics dynamics = lively(solver);
      if (!turning) dynamics.motion = {};
      dynamics.residual = 1e-6f;
      const int steps = int(std::lround((turning ? 0.25 : 1) / double(dynamics.step)));
      const SpringNetwork topology = build(kind, mesh, fur_length);
      const reference::System system{topology, dynamics};
      const reference::State rest = reference::rest(topology);
      Motions start;
      for (const glm::dvec3& q : reference::offsets(topology, rest)) {
        start.offset.emplace_back(q);
        start.speed.emplace_back(0.0f);
      }
      const auto offsets = reference::offsets(topology, reference::after(system, rest, 0, steps));

      const auto rivals = solver_rivals(topology, dynamics);
      EXPECT_GE(rivals.size(), 2u);
      for (const auto& [name, rival, threads] : rivals) {
        rival->set(start);
        for (int done = 0; done < steps; done += 40) {
          const int count = std::min(40, steps - done);
          rival->advance(moments(dynamics, done, count), count);
        }
        const double error = largest_difference(rival->state().offset, offsets) / double(fur_length);
        // Baselines in double precision still read some inputs and the initial state as floats. All other
        // baselines also compute in floats and have a larger limit.
        EXPECT_LT(error, name.find("double") != std::string::npos ? tolerance::double_baseline
                                                                  : tolerance::stick_top)
            << name << ", " << topology.sticks() << " sticks";
        rival->set(start);
        EXPECT_EQ(rival->state().offset, start.offset) << name;
      }
    }
}

INSTANTIATE_TEST_SUITE_P(All, Rivals, testing::Combine(testing::ValuesIn(kinds), testing::ValuesIn(solvers)),
                         pelage::test::by_parameter);

// Tests the backward Euler step of every baseline, which solves a linear system for the change of the
// velocities. The test computes the matrix of this system by finite differences of the reference's forces.

TEST(BaselineStep, SolvesTheSystemOfFiniteDifferences) {
  const Dynamics d = stiff_step();
  for (const Kind& kind : kinds) {
    const SpringNetwork topology = build(kind, sphere(0), fur_length);
    const reference::State state = stretched(topology);
    const Step step = step_by_differences({topology, d}, state, 0);
    const std::vector<glm::dvec3> offsets = reference::offsets(topology, state),
                                  before = speeds_of(topology, state);
    const Motions start{{offsets.begin(), offsets.end()}, {before.begin(), before.end()}};
    const auto rivals = solver_rivals(topology, d);
    EXPECT_GE(rivals.size(), 2u) << kind;
    for (const auto& [name, rival, threads] : rivals) {
      rival->set(start);
      rival->advance(moments(d, 0, 1), 1);
      const auto speeds = rival->state().speed;
      EXPECT_LT(residual_of(step, before, {speeds.begin(), speeds.end()}), tolerance::step_residual)
          << kind << ' ' << name;
    }
  }
}

}  // namespace
}  // namespace pelage::springs
