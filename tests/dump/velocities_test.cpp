// Tests the velocities in the dump of a frame that a device computed. They must agree with the velocities of
// the reference, in the same unit (the model's radius R per second) and in the same order.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "harness/compare/frame_output.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

struct Velocities : testing::TestWithParam<const char*> {};

TEST_P(Velocities, AreTheReferences) {
  constexpr int frames = 6;
  Scene scene = synthetic::lively_scene();
  scene.fur.layers = 2;
  scene.dynamics.topology = GetParam();
  const auto input = std::make_shared<FrameInput>(synthetic::frame(scene, synthetic::torus(), 12, 8, 0));
  Shells shells(cl::choose_device(""), input);
  shells.advance(frames);
  const std::vector<glm::vec3> ours = shells.velocities();
  const FrameOutput reference = reference_motion(*input, frames);
  ASSERT_EQ(ours.size(), reference.velocities.size());
  ASSERT_EQ(ours.size(), reference.tips.size());
  double worst = 0, fastest = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    worst = std::max(worst, double(glm::length(ours[i] - reference.velocities[i])));
    fastest = std::max(fastest, double(glm::length(reference.velocities[i])));
  }
  EXPECT_LT(worst, tolerance::velocity);
  EXPECT_GT(fastest, 100 * tolerance::velocity) << "something moves";
}

INSTANTIATE_TEST_SUITE_P(Of, Velocities, testing::Values("silva", "sticks", "separable-prisms"),
                         [](const auto& given) {
                           std::string text = given.param;
                           std::replace(text.begin(), text.end(), '-', '_');
                           return text;
                         });

}  // namespace
}  // namespace pelage
