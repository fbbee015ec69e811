// Tests the reference of the opacity map (docs/strands.md, section Shadow).
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "harness/strands/reference/drawing.hpp"
#include "tests/strands/support/ball.hpp"

namespace pelage::strands {
namespace {

Look look_of(Shadow reading, glm::vec3 light = {0, 1, 0}) {
  Look look;
  look.light = light;
  look.shadow = {reading, 64, 0.5f, 1};
  return look;
}

TEST(OpacityMap, TheViewLooksAlongTheLight) {
  for (const glm::vec3 light : {glm::vec3(0, 1, 0), glm::vec3(0.3f, -2, 0.5f), glm::vec3(1, 0, 0)}) {
    const Look look = look_of(Shadow::linear, light);
    const LightView view = light_view(look);
    const glm::vec3 towards = glm::normalize(light);
    const auto times = [](glm::vec4 row, glm::vec3 p) { return glm::dot(row, glm::vec4(p, 1)); };
    EXPECT_NEAR(times(view.row_z, towards), -1, 1e-6);
    EXPECT_NEAR(times(view.row_x, towards), 0, 1e-4);
    EXPECT_NEAR(times(view.row_y, towards), 0, 1e-4);
    // The silhouette of the ball is two texels from the edge of the map.
    const glm::vec3 side = glm::normalize(glm::vec3(view.row_x));
    EXPECT_NEAR(times(view.row_x, side), 30, 1e-3);
    EXPECT_NEAR(double(view.texel), 1.0 / 30, 1e-6);
  }
}

TEST(OpacityMap, AWideStrandGivesItsDepthAndAlpha) {
  Look look = look_of(Shadow::linear);
  look.taper = 0;
  const LightView view = light_view(look);
  // Two strands across the map, one above the other, of eight texels' width.
  const float width = 8 * view.texel;
  const std::vector<DrawnStrand> strands{straight({-0.9f, 0.1f, 0}, {0.9f, 0.1f, 0}, width),
                                         straight({-0.9f, 0.4f, 0}, {0.9f, 0.4f, 0}, width)};
  const reference::OpacityMap map = reference::opacity_map(look, view, strands);
  const reference::LightColumns columns = reference::light_columns(look, view, strands);
  const std::size_t middle = 32 * 64 + 32;
  ASSERT_EQ(columns[middle].size(), 2u);
  const double alpha = columns[middle][0].alpha;
  EXPECT_NEAR(alpha, columns[middle][1].alpha, 1e-12);
  EXPECT_NEAR(alpha, double(look.opacity) * (1 - 0.125), 0.02);  // near t = 1/2
  EXPECT_NEAR(map[middle].first, -0.4, 1e-6);                    // the light is above
  EXPECT_NEAR(map[middle].through, (1 - alpha) * (1 - alpha), 1e-12);
  EXPECT_EQ(map[0].through, 1);
  // At the depth of the second strand, 0.3 behind the first. The light is the mean of the four texels in the
  // middle.
  const double part = 0.3 / 0.5;
  const auto mean = [&](const auto& light) {
    double sum = 0;
    for (const std::size_t i : {middle, middle - 1, middle - 64, middle - 65})
      sum += light(map[i].through) / 4;
    return sum;
  };
  EXPECT_NEAR(reference::key_light(look, view, map, {0.001, 0.1, 0.001}),
              mean([&](double through) { return 1 - (1 - through) * part; }), 1e-3);
  look.shadow.reading = Shadow::exponential;
  EXPECT_NEAR(reference::key_light(look, view, map, {0.001, 0.1, 0.001}),
              mean([&](double through) { return std::pow(through, part); }), 1e-3);
  EXPECT_NEAR(reference::key_light(look, view, map, {0.001, -0.9, 0.001}),
              mean([](double through) { return through; }), 1e-3);
  EXPECT_EQ(reference::key_light(look, view, map, {0.001, 0.9, 0.001}), 1);
  EXPECT_EQ(reference::key_light(look, view, map, {0.9, -0.9, 0.9}), 1);
}

TEST(OpacityMap, TheExponentialReadingIsTheTransmittanceOfEvenFur) {
  // 200 fragments at equal distances: the transmittance towards the light falls exponentially.
  reference::LightColumns columns(1);
  for (int i = 0; i < 200; ++i) columns[0].push_back({0.02, 0.5 * i / 200});
  const reference::Texel texel = reference::opacity_map(columns).front();
  EXPECT_NEAR(-std::log(texel.through), 4.04, 0.01);
  double linear = 0;
  for (int i = 0; i < 200; ++i) {
    const double depth = 0.5 * i / 200, through = std::pow(0.98, i);
    EXPECT_NEAR(reference::texel_light(look_of(Shadow::exponential), texel, depth), through, 1e-9);
    linear += std::abs(reference::texel_light(look_of(Shadow::linear), texel, depth) - through) / 200;
  }
  EXPECT_GT(linear, 0.2);
}

TEST(OpacityMap, AnOpaqueTexelHasALimitedOpticalDepth) {
  const Look look = look_of(Shadow::exponential);
  EXPECT_NEAR(reference::texel_light(look, {0, 0}, 0.25), 0x1p-10, 1e-9);
  EXPECT_NEAR(reference::texel_light(look, {0, 0}, 9), 0x1p-20, 1e-12);
}

// Tests the reference of the skin (docs/strands.md, section Skin) against a plane and a ball, whose depths
// and colours are known.

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
