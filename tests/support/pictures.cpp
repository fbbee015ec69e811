#include "tests/support/pictures.hpp"

#include <fmt/format.h>

#include <cstring>

#include "harness/mesh/mesh.hpp"
#include "harness/prepare/prepare.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::pictures {

std::shared_ptr<const FrameInput> model_frame(const std::string& model, int layers,
                                              const std::string& shading, int width) {
  Scene scene;
  scene.model = model;
  scene.fur.length = .08f;
  scene.fur.layers = layers;
  scene.curl.radius = .012f;
  scene.curl.turns = 1.5f;
  scene.wetness.random = 4368;
  scene.wetness.patch_cover = .45f;
  scene.clump.shape = .3f;
  scene.dynamics.wind = {{1, .1f, -.4f}, .008f, .6f, 1, 2};
  scene.shading.model = shading;
  scene.image.width = width;
  scene.image.height = width * 5 / 8;
  return prepare(scene, load_model(model));
}

std::shared_ptr<const FrameInput> small_frame(const std::string& shading, const std::string& binding,
                                              int layers) {
  Scene scene = synthetic::lively_scene();
  scene.shading.model = shading;
  scene.fur.binding = binding;
  scene.fur.layers = layers;
  return std::make_shared<FrameInput>(synthetic::frame(scene, synthetic::torus(), 48, 32, 60));
}

Picture drawn_by_reference(const FrameInput& input, reference::Mutant mutant, bool eight_bit) {
  reference::Options options;
  options.frames = frames;
  options.eight_bit = eight_bit;
  options.mutant = mutant;
  return reference::render(input, options);
}

bool same_bits(const Picture& a, const Picture& b) {
  return a.pixel.size() == b.pixel.size() &&
         std::memcmp(a.pixel.data(), b.pixel.data(), a.pixel.size() * sizeof a.pixel[0]) == 0;
}

std::string describe(const Agreement& a) {
  return fmt::format(
      "{:.1f} dB, {:.1f} dB without {} flips, 99.9% within {:.5f}, worst {:.4f} at ({}, {}), {} fur pixels",
      a.psnr, a.psnr_without_flips, a.flips, a.p999, a.worst, a.worst_x, a.worst_y, a.pixels);
}

testing::AssertionResult same(const Picture& expected, const Picture& drawn, std::size_t least_pixels) {
  const Agreement agreement = compare(expected, drawn);
  testing::Test::RecordProperty("agreement", describe(agreement));
  const bool enough = agreement.pixels > least_pixels;
  return testing::AssertionResult(within(agreement) && enough)
         << describe(agreement) << (enough ? "" : ", which are too few");
}

Cases models_and_bindings() {
  Cases cases;
  for (const char* shading : {"curling", "wet"})
    for (const char* binding : {"shared", "separate"})
      cases.emplace_back(fmt::format("{}, {}", shading, binding), *small_frame(shading, binding));
  return cases;
}

Cases other_readings() {
  FrameInput wet = *small_frame("wet");
  wet.scene.fur.layer_spacing = "uniform";
  wet.scene.fur.layer_correction = "fragment";
  wet.scene.clump.scale = "literal";
  wet.scene.clump.gain = 1;
  wet.scene.clump.cells = "literal";
  wet.scene.wetness.blend = "near";
  wet.scene.blend.faces = "all";
  wet.scene.shading.tangent = "drawn";
  wet.scene.shading.wrap = 0;
  FrameInput curling = wet;
  curling.scene.shading.model = "curling";
  curling.scene.shading.lights.resize(1);
  curling.scene.clump.gain = 40;
  curling.scene.clump.cells = "separate";
  FrameInput power = curling;
  power.scene.shading.exponent = 7.5f;  // not a whole number, so pow() is needed
  power.scene.fur.shade = 0;            // the shades in the texture are not read
  return {{"wet", wet}, {"curling", curling}, {"exponent 7.5, one shade", power}};
}

Cases clump_readings() {
  Cases cases;
  for (const auto& [scale, tangent] : {std::pair{"converge", "paper"}, {"distance", "printed"}}) {
    FrameInput& input = cases.emplace_back(fmt::format("{}, {}", scale, tangent), *small_frame("wet")).second;
    input.scene.clump.scale = scale;
    input.scene.shading.tangent = tangent;
  }
  return cases;
}

Cases consistent_borders() {
  Cases cases;
  for (const char* scale : clump_scales) {
    FrameInput& input = cases.emplace_back(scale, *small_frame("wet")).second;
    input.scene.clump.cells = "consistent";
    input.scene.wetness.blend = "overlap";
    input.scene.clump.scale = scale;
  }
  return cases;
}

Cases soaked_fur() {
  Cases cases = consistent_borders();
  std::erase_if(cases, [](const auto& c) { return c.first != "converge" && c.first != "distance"; });
  for (auto& [scale, input] : cases) input.scene.soaked.threshold = 0.6f;
  return cases;
}

Cases orders_of_faces() {
  Cases cases;
  for (const char* faces : {"front", "back-then-front"})
    for (const char* binding : {"shared", "separate"})
      cases.emplace_back(fmt::format("{}, {}", faces, binding), *small_frame("wet", binding))
          .second.scene.blend.faces = faces;
  return cases;
}

Cases other_sizes() {
  Cases cases;
  for (const auto& [width, height] : {std::pair{1, 1}, {17, 33}, {161, 99}}) {
    FrameInput& input =
        cases.emplace_back(fmt::format("{}x{}", width, height), *small_frame("curling")).second;
    input.camera = synthetic::camera(input.scene.camera, width, height);
    input.scene.image.width = width;
    input.scene.image.height = height;
  }
  return cases;
}

Cases fur_behind_the_eye(int layers) {
  Scene scene = synthetic::lively_scene();
  scene.fur.layers = layers;
  scene.fur.length = .05f;
  scene.camera.eye = {.13f, -.21f, .25f};
  scene.camera.target = {.3f, 1.2f, 0};
  scene.camera.up = {0, 0, 1};
  scene.camera.fov = 70;
  Cases cases;
  for (const int cells : {1, 7})
    cases.emplace_back(fmt::format("{} cells", cells),
                       synthetic::frame(scene, synthetic::square(6), cells, cells, 30));
  return cases;
}

FrameInput square_seen_from(float side, const std::string& shading, const std::string& sides) {
  Scene scene = synthetic::lively_scene();
  scene.fur.length = .05f;
  scene.shading.model = shading;
  scene.shading.sides = sides;
  scene.shading.lights = {LightScene{{.2f, .3f, side}, 1.5f}};
  scene.camera.eye = {.3f, .4f, 1.6f * side};
  scene.camera.target = {0, 0, 0};
  scene.camera.up = {0, 1, 0};
  return synthetic::frame(scene, synthetic::square(1.4), 12, 12, 30);
}

}  // namespace pelage::pictures
