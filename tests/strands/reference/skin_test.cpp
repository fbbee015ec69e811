// Tests the reference of the skin (docs/strands.md, section Skin) against a plane and a ball, whose depths
// and colours are known.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/strands/reference/drawing.hpp"
#include "tests/strands/support/ball.hpp"

namespace pelage::strands {
namespace {

/// A square in the plane z = 0, seen from a point on the z axis.
SkinSurface square(float side) {
  SkinSurface skin;
  for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
    skin.position.emplace_back(0.5f * side * corner.x, 0.5f * side * corner.y, 0);
    skin.normal.emplace_back(0, 0, 1);
    skin.colour.emplace_back(0.5f + 0.25f * corner.x, 0.5f, 0.2f);
  }
  skin.triangle = {{0, 1, 2}, {0, 2, 3}};
  return skin;
}

Look plain_look() {
  Look look;
  look.light = {0, 0, 1};
  look.ambient = 0.25f;
  look.intensity = 0.5f;
  return look;
}

const reference::SkinPixel& at(const std::vector<reference::SkinPixel>& pixels, const Camera& camera, int x,
                               int y) {
  return pixels[std::size_t(y) * std::size_t(camera.width) + std::size_t(x)];
}

TEST(ReferenceSkin, OfAPlaneHasItsDepthAndItsLight) {
  const Camera camera = camera_at(64, 48, {0, 0, 3}, 0.01f);
  const auto pixels = reference::skin_pixels(camera, plain_look(), square(1), nullptr);
  const reference::SkinPixel& middle = at(pixels, camera, 32, 24);
  EXPECT_NEAR(middle.depth, 3, 1e-6);
  EXPECT_NEAR(middle.colour.y, 0.5 * 0.75, 1e-6);
  // The centre of this pixel is half a pixel to the right of the middle of the picture: at x = 1.5 `pixel` R.
  EXPECT_NEAR(middle.colour.x, 0.75 * (0.5 + 0.25 * 2 * 1.5 * double(camera.pixel)), 1e-6);
  EXPECT_TRUE(std::isinf(at(pixels, camera, 1, 1).depth));
}

TEST(ReferenceSkin, IsShadowedAsTheRootsOfTheStrandsAre) {
  const Camera camera = camera_at(64, 48, {0, 0, 3}, 0.01f);
  Look look = plain_look();
  look.skin_shadow = 0.4f;
  const auto pixels = reference::skin_pixels(camera, look, square(1), nullptr);
  EXPECT_NEAR(at(pixels, camera, 32, 24).colour.y, 0.6 * 0.5 * 0.75, 1e-6);
}

TEST(ReferenceSkin, InFrontOfTheNearPlaneHasNoPixels) {
  const Camera camera = camera_at(64, 48, {0, 0, 3}, 3.5f);
  for (const reference::SkinPixel& pixel : reference::skin_pixels(camera, plain_look(), square(1), nullptr))
    EXPECT_TRUE(std::isinf(pixel.depth));
}

TEST(ReferenceSkin, HidesFragmentsBehindIt) {
  const reference::SkinPixel pixel{glm::dvec3(0), 2};
  EXPECT_EQ(reference::before_skin(pixel, 1.9), 1);
  EXPECT_EQ(reference::before_skin(pixel, 2), 1);
  EXPECT_NEAR(reference::before_skin(pixel, 2 + 0.5 / 128), 0.5, 1e-12);
  EXPECT_EQ(reference::before_skin(pixel, 2.1), 0);
  EXPECT_EQ(reference::before_skin({}, 100), 1);
}

}  // namespace
}  // namespace pelage::strands
