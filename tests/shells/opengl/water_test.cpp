// Tests that the OpenGL baseline draws water that changes over time (docs/shells.md, section 10).
#include <gtest/gtest.h>

#include <stdexcept>

#include "harness/compare/checks.hpp"
#include "tests/shells/opengl/scenes.hpp"

namespace pelage {
namespace {

using namespace rival_tests;

TEST(OpenGlWater, ANewMaskGivesThePictureOfAFreshScene) {
  FrameInput input = *small_frame("wet");
  input.scene.wetness.soak = .3f;
  ASSERT_GT(input.droplets.size(), 0u);
  const auto shared = std::make_shared<FrameInput>(input);
  const std::vector<glm::vec4> mask = mask_of(input), none(mask.size());
  OpenGl changed(shared, none);
  changed.bend(tips_of(input));
  changed.frame();
  const Picture dry = changed.read();
  changed.set_mask(mask);
  changed.frame();
  const Picture wet = changed.read(), fresh = drawn_by_opengl(shared);
  EXPECT_FALSE(same_bits(wet, dry));
  EXPECT_TRUE(same_bits(wet, fresh));
  for (const Check& check : other_filter_checks(against_reference, compare(wet, drawn_by_reference(input))))
    EXPECT_TRUE(check.holds()) << check.metric << " " << check.value;
  EXPECT_THROW(changed.set_mask({}), std::exception);
}

TEST(OpenGlWater, OfAStillSceneKeepsItsMask) {
  const auto still = small_frame("wet");
  OpenGl opengl(still, mask_of(*still));
  EXPECT_THROW(opengl.set_mask(mask_of(*still)), std::logic_error);
}

}  // namespace
}  // namespace pelage
