// Tests the shadows of fur on itself: shading.self_shadow "off" and "traced" (docs/shells.md, section 6).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/error.hpp"
#include "harness/prepare/fur_texture.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/shells/reference/light.hpp"
#include "harness/shells/reference/textures.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/rasterize_in_double.hpp"
#include "tests/support/style_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

namespace shim = in_double;
using shim::shim_of;
using namespace pictures;
using synthetic::Any;

glm::dvec3 shift_of(const glm::dvec3& rise, const glm::dvec3& normal, const glm::dvec3& light) {
  return shim::glm_of(shim::light_shift(shim_of(rise), shim_of(normal), shim_of(light)));
}

TEST(TracedShadow, TheRayMeetsTheStrandOfTheShiftedRoot) {
  for (std::uint32_t trial = 0; trial < 2000; ++trial) {
    Any any{trial};
    const glm::dvec3 rise = .1 * any.vector(), normal = any.direction(), light = any.direction();
    const glm::dvec3 shift = shift_of(rise, normal, light);
    EXPECT_LT(glm::length(glm::cross(shift + rise, light)), 1e-12);
    if (glm::dot(normal, light) >= .25) {
      EXPECT_NEAR(glm::dot(shift, normal), 0, 1e-12);
    }
  }
  EXPECT_EQ(shim::above_horizon(-1), 0);
  EXPECT_EQ(shim::above_horizon(-.25), 0);
  EXPECT_EQ(shim::above_horizon(0), .5);
  EXPECT_EQ(shim::above_horizon(.25), 1);
}

/// Returns a frame whose fur has random coverages; all are `constant` if this is not negative.
FrameInput furry(int layers, int constant, std::uint32_t seed) {
  FrameInput input;
  input.scene.fur.layers = layers;
  input.scene.fur.density = .75f;
  input.scene.shading.self_shadow = "traced";
  input.fur = {4, layers, {{}}};
  Any any{seed};
  for (int i = 0; i < 16 * layers; ++i)
    input.fur.level[0].push_back({std::uint8_t(constant < 0 ? 127 + 127 * any() : constant), 0});
  input.fur_scale = {2, 3};
  input.scene.shading.lights = {LightScene{any.vector(), 1}};
  return input;
}

// The part of the light by the kernels' equations, with the lookups of the reference.
TEST(TracedShadow, IsTheReferences) {
  for (const int layers : {1, 2, 16, 17, 64, 200})
    for (std::uint32_t trial = 0; trial < 50; ++trial) {
      const FrameInput input = furry(layers, -1, trial);
      Any any{1000 + trial};
      const int n = int(std::abs(any()) * (layers + .99)) - 1, above = layers - 1 - n;
      const glm::dvec3 light = glm::normalize(glm::dvec3(input.scene.shading.lights[0].direction));
      const glm::dvec3 a = any.vector(), b = any.vector(), normal = any.direction(), t = any.vector(),
                       along = any.vector();
      const glm::dvec2 root(any(), any()), drift(any(), any());
      const auto at = [&](int m) { return .01 * (m + 1) * a + .0001 * (m + 1) * (m + 1) * b; };
      const double found =
          reference::light_through(input, {n, root, normal, t, along, 0, [&](int m) { return at(m) - at(n); },
                                           [&](int m) { return double(m - n) * drift; }});
      double expected = shim::above_horizon(glm::dot(normal, light));
      const int every = above <= 16 ? 1 : (above + 15) / 16;
      for (int m = n + every; m < layers; m += every) {
        const glm::dvec3 shift = shift_of(at(m) - at(n), normal, light);
        const shim::real2 uv = shim::shift_in_uv(shim_of(shift), shim_of(t), shim_of(along));
        const glm::dvec2 there = root + glm::dvec2(uv.x, uv.y) + double(m - n) * drift;
        const double power = coverage_power(input.scene.fur);
        expected *= std::pow(
            1 - .75 * reference::sample_fur(input.fur, there * glm::dvec2(2, 3), m, 0, power).coverage,
            every);
      }
      EXPECT_NEAR(found, expected, 1e-9) << layers << " layers, from " << n;
    }
}

// Through fur of the coverage a, each layer above a fragment lets 1 - a of the light through.
TEST(TracedShadow, OfEvenFurIsAPower) {
  for (const int layers : {1, 8, 16, 64})
    for (const int from : {-1, 0, layers / 2, layers - 1}) {
      FrameInput input = furry(layers, 26, 1);
      input.scene.fur.layer_correction = "texel";
      input.scene.shading.lights[0].direction = {0, 0, 1};
      const double found = reference::light_through(input, {from,
                                                            {},
                                                            {0, 0, 1},
                                                            {1, 0, 0},
                                                            {0, 1, 0},
                                                            0,
                                                            [](int m) { return glm::dvec3(0, 0, .01 * m); },
                                                            [](int) { return glm::dvec2(0); }});
      const int above = layers - 1 - from, every = std::max(1, (above + 15) / 16);
      EXPECT_NEAR(found, std::pow(1 - .75 * 26 / 255, above / every * every), 1e-12)
          << layers << ", " << from;
    }
}

std::shared_ptr<FrameInput> shadowed(const FrameInput& input, const std::string& shadow = "traced") {
  auto other = std::make_shared<FrameInput>(input);
  other->scene.shading.self_shadow = shadow;
  return other;
}

void expect_alike_in_all_mappings(const std::string& name, const std::shared_ptr<FrameInput>& input) {
  const Picture expected = drawn_by_reference(*input);
  for (const std::string& mapping : mappings())
    EXPECT_TRUE(same(expected, drawn_by_device(input, mapping), 1000)) << name << ", " << mapping;
}

TEST(SelfShadows, LookLikeTheReferenceInEveryMapping) {
  Cases cases = models_and_bindings();
  for (const Cases& more : {clump_readings(), soaked_fur()}) cases.push_back(more.back());
  cases.emplace_back("sub-steps", *small_frame("wet")).second.scene.fur.substeps = 4;
  cases.emplace_back("thin", *small_frame("curling")).second.scene.fur.density = .5f;
  cases.emplace_back("from behind", square_seen_from(-1, "curling", "two"));
  for (const auto& [name, input] : cases) expect_alike_in_all_mappings(name, shadowed(input));
  for (const char* model : {"curling", "wet", "lambert"})
    expect_alike_in_all_mappings(model, shadowed(*small_frame(model), "off"));
}

TEST(SelfShadows, OfFewAndOfManyLayersLookLikeTheReference) {
  for (const int layers : {2, 40})
    EXPECT_TRUE(drawn_alike(shadowed(*small_frame("curling", "shared", layers)), "tile", 1000)) << layers;
  auto input = shadowed(*small_frame("curling"));
  input->scene.blend.order = "depth";
  EXPECT_TRUE(drawn_alike(input, "group", 1000));
}

TEST(SelfShadows, OfMapsAndCollidersLookLikeTheReference) {
  const auto traced = [](Scene& s) { s.shading.self_shadow = "traced"; };
  EXPECT_TRUE(drawn_alike(style_scenes::with_all_maps(traced), "tile", 2000));
  EXPECT_TRUE(drawn_alike(style_scenes::pressed_fur(traced), "tile", 2000));
}

TEST(SelfShadows, DifferAndAreSeen) {
  const auto input = small_frame("curling");
  const Picture traced = drawn_by_device(shadowed(*input), "tile"),
                off = drawn_by_device(shadowed(*input, "off"), "tile");
  for (const char* other : {"darkening", "off"})
    EXPECT_FALSE(within(compare(drawn_by_reference(*shadowed(*input, other)), traced))) << other;
  for (std::size_t i = 0; i < off.pixel.size(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_LE(traced.pixel[i][c], off.pixel[i][c] + 1e-5f);
}

TEST(SelfShadows, HaveTheSameBitsInAllTilesAndRuns) {
  const auto input = shadowed(*small_frame("wet"));
  const Picture first = drawn_by_device(input, "tile");
  for (const std::map<std::string, int>& tuning :
       {std::map<std::string, int>{}, {{"TILE_W", 8}, {"TILE_H", 8}, {"GROUP", 5}}, {{"GROUP", 1}}})
    EXPECT_TRUE(same_bits(first, drawn_with(input, {"tile", tuning})));
}

// Traced shadows need programs and buffers that a renderer of other shadows does not have.
TEST(SelfShadows, AreNoPartOfTheView) {
  EXPECT_TRUE(is_view_key("shading.shadow"));
  EXPECT_FALSE(is_view_key("shading.self_shadow"));
}

TEST(SelfShadows, NeedLayersOfOneCurve) {
  Scene scene = synthetic::lively_scene();
  scene.shading.model = "lambert";
  scene.dynamics.topology = "sticks";
  scene.dynamics.bend = "trigonometric";
  EXPECT_NO_THROW(check_scene(scene));
  scene.shading.self_shadow = "traced";
  EXPECT_THROW(check_scene(scene), InputError);
}

}  // namespace
}  // namespace pelage
