// A baseline is another implementation of the solvers: serial C++ loops or the library Eigen. This file tests
// the backward Euler step of every baseline. A backward Euler step solves a linear system for the change of
// the velocities. The test computes the matrix of this system by finite differences of the reference's
// forces. The baseline's change of the velocities must solve the system.
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
    Motions start;
    std::vector<glm::dvec3> before;
    for (std::size_t i = 0; i < topology.sticks(); ++i) {
      start.offset.emplace_back(state.position[topology.top(i)] - state.position[i]);
      start.speed.emplace_back(state.velocity[topology.top(i)]);
      before.emplace_back(start.speed.back());
    }
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
