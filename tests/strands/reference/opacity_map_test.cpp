// Tests the reference of the opacity map (docs/strands.md, section Shadow).
#include "harness/strands/reference/opacity_map.hpp"

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

/// A straight strand.
DrawnStrand straight_strand(glm::vec3 root, glm::vec3 tip, float width) {
  DrawnStrand strand;
  strand.point = {root, 0.5f * (root + tip), tip};
  strand.width = width;
  return strand;
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
  const std::vector<DrawnStrand> strands{straight_strand({-0.9f, 0.1f, 0}, {0.9f, 0.1f, 0}, width),
                                         straight_strand({-0.9f, 0.4f, 0}, {0.9f, 0.4f, 0}, width)};
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

}  // namespace
}  // namespace pelage::strands
