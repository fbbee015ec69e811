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

}  // namespace pelage::pictures
