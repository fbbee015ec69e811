// Tests sticks on a skin that moves and deforms on the device, and with the kernels compiled in double
// precision.
#include "tests/springs/support/moving_skin.hpp"

#include <gtest/gtest.h>

#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "harness/springs/model/scene.hpp"
#include "harness/springs/opencl/mass_springs.hpp"
#include "harness/springs/reference/reference.hpp"
#include "tests/springs/opencl/shim.hpp"

namespace pelage::springs {
namespace {

using namespace test;
using Whole = MassSpringOptions::Whole;

struct OnMovingSkin : testing::TestWithParam<Case> {};

TEST_P(OnMovingSkin, KernelsFollowTheReference) {
  const auto& [kind, solver] = GetParam();
  constexpr int frames = 12;
  const FrameInput input = deforming_sphere(kind, solver, 8);
  const SpringNetwork rest = network_of(input);
  const DynamicsScene& scene = input.scene.dynamics;
  const Dynamics dynamics = dynamics_of(scene, rest);
  const SomeSticks expected = some_reference_sticks(input, frames, 1000);
  ASSERT_EQ(expected.stick.size(), rest.sticks());
  for (const Whole whole : {Whole::never, Whole::always}) {
    MassSprings device(queue(), rest, dynamics, {.whole = whole});
    std::vector<glm::dvec3> offsets, speeds(rest.sticks(), glm::dvec3(0)), before(speeds);
    for (const glm::vec3& n : rest.normal) offsets.emplace_back(rest.length * n);
    for (int frame = 0; frame < frames; ++frame) {
      const MovedSticks now = moved_sticks(input, rest, frame);
      const std::vector<glm::vec3> push = with_drag({}, now.velocity, dynamics.drag);
      std::vector<glm::vec3> change;
      for (std::size_t i = 0; i < before.size(); ++i) {
        change.emplace_back(now.velocity[i] - before[i]);
        speeds[i] -= now.velocity[i] - before[i];
      }
      before = now.velocity;
      device.set_skin(queue(), now.network, change);
      device.push(queue(), push);
      device.advance(queue(), scene.substeps);
      Shim shim(now.network, dynamics);
      shim.set(offsets, speeds);
      shim.push(push);
      shim.advance(scene.substeps, whole == Whole::always && kind == Kind::prisms);
      offsets = shim.offsets(), speeds = shim.speeds();
    }
    EXPECT_LT(largest_difference(offsets, expected.offset), tolerance::float_records * double(fur_length));
    EXPECT_LT(largest_difference(device.offsets(queue()), expected.offset),
              tolerance::stick_top * double(fur_length));
    std::printf("kernels in double %.2g, device %.2g of the fur's length\n",
                largest_difference(offsets, expected.offset) / double(fur_length),
                largest_difference(device.offsets(queue()), expected.offset) / double(fur_length));
  }
}

INSTANTIATE_TEST_SUITE_P(All, OnMovingSkin,
                         testing::Combine(testing::ValuesIn(kinds), testing::ValuesIn(solvers)),
                         pelage::test::by_parameter);

TEST(MovingSkinOnDevice, AnotherTopologyIsRefused) {
  const FrameInput input = deforming_sphere(Kind::sticks, Solver::rk4, 2);
  const SpringNetwork rest = network_of(input);
  MassSprings device(queue(), rest, dynamics_of(input.scene.dynamics, rest));
  EXPECT_THROW(device.set_skin(queue(), rest, {}), InputError);
  EXPECT_THROW(
      device.set_skin(queue(), build(Kind::sticks, square(2), fur_length), std::vector<glm::vec3>(13)),
      InputError);
}

}  // namespace
}  // namespace pelage::springs
