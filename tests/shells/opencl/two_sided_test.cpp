// Tests shading.sides = "two": an open surface that is seen from behind is lit as if its normals faced the
// eye.
#include <gtest/gtest.h>

#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace pictures;

/// Returns a furry square in the plane z = 0 with normals along +z. The eye is above the square if `side` is
/// 1, and below it if `side` is -1. One light shines from the eye's side.
std::shared_ptr<FrameInput> square_seen_from(float side, const std::string& shading,
                                             const std::string& sides) {
  Scene scene = synthetic::lively_scene();
  scene.fur.length = .05f;
  scene.shading.model = shading;
  scene.shading.sides = sides;
  scene.shading.lights = {LightScene{{.2f, .3f, side}, 1.5f}};
  scene.camera.eye = {.3f, .4f, 1.6f * side};
  scene.camera.target = {0, 0, 0};
  scene.camera.up = {0, 1, 0};
  return std::make_shared<FrameInput>(synthetic::frame(scene, synthetic::square(1.4), 12, 12, 30));
}

/// Returns the mean red value of the pixels that show the surface.
double brightness(const Picture& picture) {
  double sum = 0;
  std::size_t pixels = 0;
  for (const auto& p : picture.pixel)
    if (p.a > .5f) {
      sum += double(p.r);
      ++pixels;
    }
  return pixels == 0 ? 0 : sum / double(pixels);
}

struct TwoSided : testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(TwoSided, IsTheReferencesPicture) {
  const auto& [mapping, shading] = GetParam();
  for (const float side : {1.0f, -1.0f}) {
    const auto input = square_seen_from(side, shading, "two");
    EXPECT_TRUE(drawn_alike(input, mapping, 2000)) << side;
  }
}

TEST_P(TwoSided, LightsTheBackAndLeavesTheFront) {
  const char* mapping = std::get<0>(GetParam());
  const char* shading = std::get<1>(GetParam());
  const auto drawn = [&](float side, const char* sides) {
    return drawn_by_device(square_seen_from(side, shading, sides), mapping);
  };
  const Picture front = drawn(1, "one"), front_two = drawn(1, "two");
  EXPECT_EQ(compare(front, front_two).worst, 0.0);
  // Fur does not shadow the back of the surface, which shows skin. The back must be at least half as bright
  // as the fur on the front.
  const double back = brightness(drawn(-1, "two"));
  EXPECT_GT(back, 5 * brightness(drawn(-1, "one")));
  EXPECT_GT(back, 0.5 * brightness(front));
}

INSTANTIATE_TEST_SUITE_P(Of, TwoSided,
                         testing::Combine(testing::Values("tile", "pixel", "group"),
                                          testing::Values("curling", "wet", "lambert")),
                         [](const auto& given) {
                           return std::string(std::get<0>(given.param)) + "_" + std::get<1>(given.param);
                         });

}  // namespace
}  // namespace pelage
