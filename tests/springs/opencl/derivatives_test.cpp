// Tests the backward Euler step of the kernels, which solves a linear system for the change of the
// velocities. The test computes the matrix of this system by finite differences of the reference's forces,
// without the reference's formulas of the derivatives.
#include <gtest/gtest.h>

#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "harness/springs/opencl/mass_springs.hpp"
#include "tests/springs/opencl/shim.hpp"
#include "tests/springs/support/device.hpp"
#include "tests/springs/support/differences.hpp"
#include "tests/springs/support/meshes.hpp"
#include "tests/springs/support/scenes.hpp"

namespace pelage::springs {
namespace {

using namespace test;
using Whole = MassSpringOptions::Whole;

struct KernelStep : testing::TestWithParam<Kind> {};

TEST_P(KernelStep, SolvesTheSystemOfFiniteDifferences) {
  const SpringNetwork topology = build(GetParam(), sphere(0), fur_length);
  const Dynamics d = stiff_step();
  const reference::State state = stretched(topology);
  const Step step = step_by_differences({topology, d}, state, 0);
  const std::vector<glm::dvec3> offsets = reference::offsets(topology, state),
                                before = speeds_of(topology, state);
  for (const bool whole : {false, true}) {
    if (whole && !GetParam().shared_edges()) continue;
    Shim shim(topology, d);
    shim.set(offsets, before);
    shim.advance(1, whole);
    // The kernels read normals, wind and weight as floats, so the tolerance is that of single precision.
    EXPECT_LT(residual_of(step, before, shim.speeds()), tolerance::float_records) << whole;

    MassSprings device(queue(), topology, d, {.whole = whole ? Whole::always : Whole::never});
    device.set(queue(), {offsets.begin(), offsets.end()}, {before.begin(), before.end()});
    device.advance(queue(), 1);
    const auto speeds = device.speeds(queue());
    EXPECT_LT(residual_of(step, before, {speeds.begin(), speeds.end()}), tolerance::step_residual) << whole;
  }
}

// Tests a step with all terms of the derivatives. The object rotates, and some springs are stretched, others
// compressed.
TEST_P(KernelStep, WithTheFullJacobianIsThatOfTheReferenceOnly) {
  const SpringNetwork topology = build(GetParam(), sphere(0), fur_length);
  Dynamics d = lively(Solver::backward_euler);
  d.step = 1.0f / 60;
  d.edge_damping = 0.05f;
  d.full_jacobian = true;
  EXPECT_THROW(MassSprings(queue(), topology, d), InputError);
  for (const reference::State& state : {crumpled(topology), stretched(topology)}) {
    const Step step = full_step_by_differences({topology, d}, state, 0);
    const reference::State next = reference::step({topology, d}, state, 0);
    EXPECT_LT(residual_of(step, speeds_of(topology, state), speeds_of(topology, next)),
              tolerance::float_records);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, KernelStep, testing::ValuesIn(kinds.begin(), kinds.end()), kind_name);

}  // namespace
}  // namespace pelage::springs
