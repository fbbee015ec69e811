// Compares the device's opacity map, and pictures with its shadow, with the double-precision reference. The
// device must also give equal bits for every division of the work.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "harness/compare/metrics.hpp"
#include "harness/error.hpp"
#include "harness/strands/opencl/drawer.hpp"
#include "harness/strands/reference/drawing.hpp"
#include "harness/strands/reference/opacity_map.hpp"
#include "tests/strands/support/ball.hpp"
#include "tests/strands/support/strands.hpp"

namespace pelage::strands {
namespace {

DrawingScene shadow_scene(Shadow reading, float fraction = 1) {
  DrawingScene scene;
  scene.camera = camera_at(200, 150);
  scene.range = depth_range(scene.camera, 1 + longest);
  scene.first_segment = 0.45f;
  scene.look.fraction = fraction;
  scene.look.shadow = {reading, 150, 0.2f, 1 + longest};
  scene.look.light = {-0.5f, 0.8f, 0.6f};
  return scene;
}

struct Shadowed {
  std::vector<DrawnStrand> curves;
  std::vector<Entry> order;
  std::vector<glm::vec4> map;
  Picture picture;
};

Shadowed draw_with_map(const DrawingScene& scene, const Ball& ball, const DrawerOptions& options = {}) {
  Drawer drawer(test::queue(), scene, ball.strands, ball.keys.size(), options);
  const std::vector<float> records = key_records(ball.keys);
  drawer.keys().write(test::queue(), records);
  Shadowed result;
  result.curves = reference::pruned(drawer.curves(test::queue()), scene.look);
  drawer.enqueue(test::queue(), nullptr);
  result.order = drawer.order(test::queue());
  result.map = drawer.opacity_map(test::queue());
  result.picture = drawer.read(test::queue());
  return result;
}

// Coordinates in a tile of 64 texels are rounded by up to 4e-6 texels, and a coverage depends on some of
// them, so a fragment's alpha is rounded by about 1e-5. A texel has several fragments.
constexpr double rounding = 1e-4;

/// Compares the map with the reference's. A fragment at the edge of a strip may have a coverage of almost 0
/// on one side and none on the other. This changes the least depth of its texel, but hardly the
/// transmittance.
void expect_map(const DrawingScene& scene, const Shadowed& device) {
  const reference::OpacityMap expected =
      reference::opacity_map(scene.look, light_view(scene.look), device.curves);
  ASSERT_EQ(device.map.size(), expected.size());
  std::size_t covered = 0, other_depth = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_NEAR(double(device.map[i].z), expected[i].through, rounding) << "texel " << i;
    covered += expected[i].through < 1;
    const double first = expected[i].through < 1 ? expected[i].first : 1e30;
    const double behind = 2 * (expected[i].mean - expected[i].first);
    const double length =
        std::max(double(scene.look.shadow.length), scene.look.shadow.reading == Shadow::linear ? 0 : behind);
    other_depth += std::abs(double(device.map[i].x) - first) > 2e-5 * (1 + std::abs(first)) ||
                   std::abs(1 / double(device.map[i].y) - length) > 1e-3 * length;
  }
  EXPECT_GT(covered, expected.size() / 4);
  EXPECT_LE(other_depth, covered / 1000) << other_depth << " of " << covered;
}

void expect_reference_and_map(const DrawingScene& scene, const Ball& ball,
                              const DrawerOptions& options = {}) {
  const Shadowed device = draw_with_map(scene, ball, options);
  expect_map(scene, device);
  const Picture expected = reference::draw(scene.camera, scene.look, device.curves, device.order);
  const Agreement found = compare(device.picture, expected);
  EXPECT_TRUE(within(found)) << found.psnr << " dB";
  testing::Test::RecordProperty("psnr", std::to_string(found.psnr));
}

TEST(StrandShadow, MapAndPictureAreThoseOfTheReference) {
  for (const Shadow reading : {Shadow::linear, Shadow::exponential})
    expect_reference_and_map(shadow_scene(reading), Ball(3000));
}

TEST(StrandShadow, TheMappingForGpusAgreesWithTheReference) {
  DrawerOptions options;
  options.mapping = Drawing::group;
  expect_reference_and_map(shadow_scene(Shadow::exponential), Ball(2000, 2), options);
}

TEST(StrandShadow, AllLightsAgreeWithTheReference) {
  DrawingScene scene = shadow_scene(Shadow::exponential, 0.6f);
  scene.look.fills = {{{1, 0.2f, 0.3f}, {0.5f, 0.2f, 0.1f}}};
  scene.look.rim = {0.5f, 0.4f, 0.3f};
  scene.look.skin_shadow = 0.7f;
  scene.look.film.resize(2);
  for (FilmSample& sample : scene.look.film[1]) sample = {90, 140, 120};
  scene.look.segments = 5;
  expect_reference_and_map(scene, Ball(3000));
}

TEST(StrandShadow, OnlyTheKeyLightIsShadowed) {
  DrawingScene scene = shadow_scene(Shadow::exponential);
  scene.look.light = {0.2f, 0.5f, -1};  // from behind
  const Ball ball(4000);
  scene.look.intensity = 0;
  const Picture dark = draw_with_map(scene, ball).picture;
  scene.look.shadow.reading = Shadow::none;
  EXPECT_EQ(draw_with_map(scene, ball).picture.pixel, dark.pixel);
  scene.look.intensity = 1;
  const Picture lit = draw_with_map(scene, ball).picture;
  scene.look.shadow.reading = Shadow::exponential;
  const Picture shadowed = draw_with_map(scene, ball).picture;
  double lit_sum = 0, shadowed_sum = 0;
  for (std::size_t i = 0; i < lit.pixel.size(); ++i) {
    EXPECT_LE(shadowed.pixel[i].y, lit.pixel[i].y + 1e-5f);
    lit_sum += double(lit.pixel[i].y);
    shadowed_sum += double(shadowed.pixel[i].y);
  }
  EXPECT_LT(shadowed_sum, 0.95 * lit_sum);
}

TEST(StrandShadow, BitsDoNotDependOnTheDivisionOfTheWork) {
  const Ball ball(5001);
  const DrawingScene scene = shadow_scene(Shadow::linear);
  const Shadowed first = draw_with_map(scene, ball);
  for (const DrawerOptions& options :
       {DrawerOptions{}, DrawerOptions{.mapping = Drawing::item, .lanes = 1},
        DrawerOptions{.mapping = Drawing::item, .lanes = 16, .runs = 1, .chunks = 1},
        DrawerOptions{.mapping = Drawing::item, .lanes = 16, .runs = 7, .chunks = 33},
        DrawerOptions{.mapping = Drawing::item, .lanes = 1, .runs = 64, .chunks = 5}}) {
    const Shadowed other = draw_with_map(scene, ball, options);
    EXPECT_EQ(other.map, first.map) << options.lanes << " lanes, " << options.runs << " runs";
    EXPECT_EQ(other.picture.pixel, first.picture.pixel)
        << options.lanes << " lanes, " << options.runs << " runs";
  }
}

TEST(StrandShadow, AViewThatChangesGivesThePictureOfANewDrawer) {
  const Ball ball(2000);
  Drawer drawer(test::queue(), shadow_scene(Shadow::exponential), ball.strands, ball.keys.size());
  const std::vector<float> records = key_records(ball.keys);
  drawer.keys().write(test::queue(), records);
  for (const float fraction : {0.3f, 1.0f, 0.8f}) {
    DrawingScene scene = shadow_scene(Shadow::exponential, fraction);
    scene.camera = camera_at(200, 150, {-0.7f, 1, 3 + fraction});
    scene.range = depth_range(scene.camera, 1 + longest);
    scene.look.light = {fraction, 1, 0.2f};
    drawer.set_view(scene);
    drawer.enqueue(test::queue(), nullptr);
    const Shadowed fresh = draw_with_map(scene, ball);
    EXPECT_EQ(drawer.opacity_map(test::queue()), fresh.map);
    EXPECT_EQ(drawer.read(test::queue()).pixel, fresh.picture.pixel);
  }
}

TEST(StrandShadow, WrongValuesAreRefused) {
  const auto refused = [](const ShadowLook& shadow) {
    DrawingScene scene = shadow_scene(Shadow::linear);
    scene.look.shadow = shadow;
    EXPECT_THROW(check(scene.look), InputError);
  };
  refused({Shadow::linear, 15, 0.1f, 1});
  refused({Shadow::linear, 9000, 0.1f, 1});
  refused({Shadow::exponential, 512, 0, 1});
  refused({Shadow::exponential, 512, 0.1f, std::nanf("")});
  const Ball ball(20);
  Drawer drawer(test::queue(), shadow_scene(Shadow::linear), ball.strands, ball.keys.size());
  EXPECT_THROW(drawer.set_view(shadow_scene(Shadow::exponential)), InputError);
  DrawingScene larger = shadow_scene(Shadow::linear);
  larger.look.shadow.size = 200;
  EXPECT_THROW(drawer.set_view(larger), InputError);
}

}  // namespace
}  // namespace pelage::strands
