// Compares the OpenGL baseline's pictures of strands with all lights, a shadow, film strips, looks of layers,
// a level of detail and a skin with the double-precision reference.
#include <gtest/gtest.h>

#include <functional>

#include "harness/compare/metrics.hpp"
#include "harness/compare/strands.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/strands/opengl/ribbons.hpp"
#include "harness/strands/reference/drawing.hpp"
#include "harness/strands/scene/strand_input.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::strands {
namespace {

/// Two fur layers of a torus with looks of their own.
Scene scene_of() {
  Scene scene;
  scene.model = "torus";
  scene.image.width = 333;
  scene.image.height = 250;
  StrandsScene& s = scene.strands;
  s.rim = {0.2f, 0.3f, 0.1f};
  s.fills = {{{-1, 0.2f, 0.3f}, {0.3f, 0.1f, 0.2f}}, {{0.4f, -1, 0.6f}, {0.1f, 0.3f, 0.4f}}};
  s.shadow_size = 128;
  s.layers.resize(2, s.layers.front());
  for (StrandLayerScene& layer : s.layers) {
    layer.count = 1500;
    layer.length = 0.15f;
    layer.width = 0.004f;
    layer.curvature_spread = 30;
    layer.twist_spread = 90;
  }
  s.layers[1].opacity = 0.6f;
  s.layers[1].taper = 0.5f;
  s.layers[1].gloss = 3;
  s.layers[1].exponent = 0.5f;
  s.layers[1].rim = {0, 2, 1};
  s.layers[1].rim_exponent = 2;
  s.layers[1].skin_shadow = 0.5f;
  s.layers[1].response = 1.5f;
  return scene;
}

double psnr_of_look(const Scene& scene, const RibbonOptions& options = {}, bool film = false) {
  auto input = std::make_shared<StrandInput>(
      *prepare_strands(scene, std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 40, 24))));
  if (film) {
    for (int frame = 0; frame < 3; ++frame) {
      FilmFrame samples;
      for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = {std::uint8_t(60 + 20 * i), std::uint8_t(200 - 20 * i), std::uint8_t(255 - 10 * i)};
      input->look.film.push_back(samples);
    }
    input->look.layers[0].frames = 1;
    input->look.layers[1].first_frame = 1;
    input->look.layers[1].frames = 2;
  }
  Ribbons ribbons(*input, input->fur.strands, options);
  ribbons.frame(input->fur.keys);
  return compare(ribbons.read(), reference_strands(*input, input->fur.keys, input->skin).picture).psnr;
}

TEST(WholeLook, IsThatOfTheReference) {
  for (const char* shadow : {"none", "linear", "exp"})
    for (const bool skin : {false, true}) {
      Scene scene = scene_of();
      scene.strands.shadow = shadow;
      scene.strands.skin = skin;
      const double psnr = psnr_of_look(scene);
      EXPECT_GE(psnr, tolerance::other_filter_psnr) << shadow << ", skin " << skin;
      std::printf("%s, skin %d: %.1f dB\n", shadow, int(skin), psnr);
    }
}

TEST(WholeLook, OfEveryControlIsThatOfTheReference) {
  for (const auto& [name, change] : std::vector<std::pair<const char*, std::function<void(StrandsScene&)>>>{
           {"fraction", [](StrandsScene& s) { s.fraction = 0.4f; }},
           {"segments of each strand",
            [](StrandsScene& s) {
              s.subdivision = "strand";
              // With few segments, the strips of OpenGL differ more at sharp bends.
              for (StrandLayerScene& layer : s.layers) layer.curvature_spread = 10;
            }},
           {"strands that face away last", [](StrandsScene& s) { s.back_facing = "last"; }},
           {"strands that face away drawn", [](StrandsScene& s) { s.back_facing = "drawn"; }},
           {"near plane", [](StrandsScene& s) { s.layers[1].length = 0.4f; }},
           {"no shadow of the skin", [](StrandsScene& s) { s.skin_shadow = 0; }},
           {"key light alone", [](StrandsScene& s) {
              s.rim = glm::vec3(0);
              s.fills.clear();
              s.skin_shadow = 0;
              for (StrandLayerScene& layer : s.layers)
                layer.opacity = layer.taper = layer.gloss = layer.exponent = layer.rim_exponent =
                    layer.skin_shadow = 1,
                layer.rim = glm::vec3(1);
            }}}) {
    Scene scene = scene_of();
    change(scene.strands);
    if (std::string(name) == "key light alone") scene.shading.lights.resize(1);
    if (std::string(name) == "near plane") {  // the camera is in the fur
      scene.camera.framed = false;
      scene.camera.eye = {0.75f, 0.35f, 0.75f};
      scene.camera.target = {0, 0, 0};
    }
    const double psnr = psnr_of_look(scene);
    EXPECT_GE(psnr, tolerance::other_filter_psnr) << name;
    std::printf("%s: %.1f dB\n", name, psnr);
  }
  EXPECT_GE(psnr_of_look(scene_of(), {"indexed", "rgba32f"}), tolerance::other_filter_psnr);
  EXPECT_GE(psnr_of_look(scene_of(), {}, true), tolerance::other_filter_psnr) << "film strips";
}

}  // namespace
}  // namespace pelage::strands
