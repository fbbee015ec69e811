// Compares the device's opacity map, and pictures with its shadow, with the double-precision reference. The
// device must also give equal bits for every division of the work.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/groom/fur.hpp"
#include "harness/strands/reference/drawing.hpp"
#include "tests/strands/support/device_picture.hpp"

namespace pelage::strands {
namespace {

DrawingScene shadow_scene(Shadow reading, float fraction = 1) {
  DrawingScene scene = ball_scene(200, 150);
  scene.look.fraction = fraction;
  scene.look.shadow = {reading, 150, 0.2f, 1 + longest};
  scene.look.light = {-0.5f, 0.8f, 0.6f};
  return scene;
}

// Coordinates in a tile of 64 texels are rounded by up to 4e-6 texels, and a coverage depends on some of
// them, so a fragment's alpha is rounded by about 1e-5. A texel has several fragments.
constexpr double rounding = 1e-4;

/// Compares the map with the reference's. A fragment at the edge of a strip may have a coverage of almost 0
/// on one side and none on the other. This changes the least depth of its texel, but hardly the
/// transmittance.
void expect_map(const DrawingScene& scene, const DevicePicture& device) {
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
  const DevicePicture device = draw_on_device(scene, ball, options);
  expect_map(scene, device);
  expect_reference_picture(scene, device);
}

TEST(StrandShadow, MapAndPictureAreThoseOfTheReference) {
  for (const Shadow reading : {Shadow::linear, Shadow::exponential})
    expect_reference_and_map(shadow_scene(reading), Ball(3000));
}

TEST(StrandShadow, TheMappingForGpusAgreesWithTheReference) {
  expect_reference_and_map(shadow_scene(Shadow::exponential), Ball(2000, 2), {.mapping = Drawing::group});
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
  const Picture dark = draw_on_device(scene, ball).picture;
  scene.look.shadow.reading = Shadow::none;
  EXPECT_EQ(draw_on_device(scene, ball).picture.pixel, dark.pixel);
  scene.look.intensity = 1;
  const Picture lit = draw_on_device(scene, ball).picture;
  scene.look.shadow.reading = Shadow::exponential;
  const Picture shadowed = draw_on_device(scene, ball).picture;
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
  const DevicePicture first = draw_on_device(scene, ball);
  for (const DrawerOptions& options :
       {DrawerOptions{}, DrawerOptions{.mapping = Drawing::item, .lanes = 1},
        DrawerOptions{.mapping = Drawing::item, .lanes = 16, .runs = 1, .chunks = 1},
        DrawerOptions{.mapping = Drawing::item, .lanes = 16, .runs = 7, .chunks = 33},
        DrawerOptions{.mapping = Drawing::item, .lanes = 1, .runs = 64, .chunks = 5}}) {
    const DevicePicture other = draw_on_device(scene, ball, options);
    EXPECT_EQ(other.map, first.map) << options.lanes << " lanes, " << options.runs << " runs";
    EXPECT_EQ(other.picture.pixel, first.picture.pixel)
        << options.lanes << " lanes, " << options.runs << " runs";
  }
}

TEST(StrandShadow, AViewThatChangesGivesThePictureOfANewDrawer) {
  const Ball ball(2000);
  Drawer drawer(test::queue(), shadow_scene(Shadow::exponential), ball.strands, ball.keys.size());
  for (const float fraction : {0.3f, 1.0f, 0.8f}) {
    DrawingScene scene = shadow_scene(Shadow::exponential, fraction);
    scene.camera = camera_at(200, 150, {-0.7f, 1, 3 + fraction});
    scene.range = depth_range(scene.camera, 1 + longest);
    scene.look.light = {fraction, 1, 0.2f};
    drawer.set_view(scene);
    const DevicePicture fresh = draw_on_device(scene, ball);
    EXPECT_EQ(drawn_with(drawer, ball.keys).pixel, fresh.picture.pixel);
    EXPECT_EQ(drawer.opacity_map(test::queue()), fresh.map);
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

// Compares the reading "exp" of the opacity map with the transmittance towards the light of dense fur
// (docs/strands.md, section Shadow), in double precision.
struct DenseLook {
  const char* name;
  int strands;
  float length, width;  ///< R
  float lean;           ///< degrees
};
constexpr DenseLook dense_looks[] = {{"short", 200000, 0.06f, 0.003f, 20},
                                     {"combed", 100000, 0.15f, 0.003f, 50},
                                     {"thick", 40000, 0.2f, 0.008f, 40}};

struct DenseFur {
  Fur fur;
  std::vector<DrawnStrand> strands;  ///< at rest
  Look look;                         ///< its shadow is Shadow::exponential
};

/// Returns fur with the values of `look` on the mesh. DenseFur::look has an opacity map of `size` x `size`
/// texels.
DenseFur dense_fur(const Mesh& mesh, const DenseLook& look, int size) {
  StrandsScene scene;
  StrandLayerScene& layer = scene.layers.front();
  layer.count = look.strands;
  layer.length = look.length;
  layer.width = look.width;
  layer.lean = look.lean;
  CoatTexture coat;  // one texel
  coat.size = 1;
  coat.texel.resize(1);
  DenseFur result;
  result.fur = grow(mesh, scene, coat);
  for (const KeyedStrand& s : result.fur.strands)
    result.strands.push_back(reference::between(result.fur.keys, s, 0.5f));
  result.look.shadow = {Shadow::exponential, size, layer.length,
                        1 + layer.length * (1 + layer.length_spread)};
  return result;
}

/// A fragment in the light's view.
struct LightSample {
  std::size_t texel = 0;  ///< number of its texel, row by row
  double depth = 0;       ///< R
  double through = 1;     ///< product of 1 - alpha over the fragments of the texel that lie before it
};

/// Returns the fragments of all texels, in each texel by ascending depth.
std::vector<LightSample> light_samples(reference::LightColumns columns) {
  std::vector<LightSample> samples;
  for (std::size_t texel = 0; texel < columns.size(); ++texel) {
    std::stable_sort(columns[texel].begin(), columns[texel].end(),
                     [](const auto& a, const auto& b) { return a.depth < b.depth; });
    double through = 1;
    for (const reference::LightFragment& f : columns[texel]) {
      samples.push_back({texel, f.depth, through});
      through *= 1 - f.alpha;
    }
  }
  return samples;
}

TEST(StrandShadowError, OfTheReadingExpIsSmallInDenseFur) {
  Scene scene;
  scene.model = "bunny";
  const auto mesh = load_scene_mesh(scene, [](const std::string&) {});
  for (const DenseLook& dense : dense_looks) {
    const DenseFur fur = dense_fur(*mesh, dense, 256);
    const reference::LightColumns columns =
        reference::light_columns(fur.look, light_view(fur.look), fur.strands);
    const reference::OpacityMap map = reference::opacity_map(columns);
    const std::vector<LightSample> samples = light_samples(columns);
    double error = 0, optical_depth = 0;
    for (const LightSample& s : samples) {
      error += std::abs(reference::texel_light(fur.look, map[s.texel], s.depth) - s.through);
      optical_depth += -std::log(std::max(map[s.texel].through, 1e-12));
    }
    EXPECT_GT(optical_depth / double(samples.size()), 3);
    EXPECT_LT(error / double(samples.size()), tolerance::shadow_error) << dense.name;
  }
}

}  // namespace
}  // namespace pelage::strands
