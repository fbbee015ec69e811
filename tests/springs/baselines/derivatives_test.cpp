// Tests the backward Euler step of every baseline, which solves a linear system for the change of the
// velocities. The test computes the matrix of this system by finite differences of the reference's forces.
#include <gtest/gtest.h>

#include "harness/compare/tolerances.hpp"
#include "harness/springs/baselines/baselines.hpp"
#include "tests/springs/support/differences.hpp"
#include "tests/springs/support/meshes.hpp"
#include "tests/springs/support/scenes.hpp"

namespace pelage::springs {
namespace {

using namespace test;

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
