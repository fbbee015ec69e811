// Tests that the scenes of examples/ are as bright with 16 layers as with 64.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "harness/picture/picture.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/shells/reference/reference.hpp"

namespace pelage {
namespace {

struct Look {
  const char* name;
  std::vector<const char*> with_16;        ///< settings that the scene file recommends for 16 layers
  std::vector<const char*> with_substeps;  ///< additional settings for 16 layers with four sub-steps
};

void PrintTo(const Look& look, std::ostream* out) {
  *out << look.name;
}

Scene scene_of(const Look& look, int layers) {
  Scene scene =
      read_scene(std::filesystem::path(PELAGE_SOURCE_DIR) / "examples" / (std::string(look.name) + ".toml"));
  scene.fur.layers = layers;
  if (layers == 16)
    for (const char* assignment : look.with_16) apply_set(scene, assignment);
  check_scene(scene);
  return scene;
}

/// Divides the picture into windows of 16 x 16 pixels and returns one in six of them. The chosen columns
/// differ from row to row.
std::vector<Window> sample(const ImageScene& image) {
  std::vector<Window> windows;
  for (int y = 0; y + 16 <= image.height; y += 16)
    for (int x = 0; x + 16 <= image.width; x += 16)
      if ((x / 16 + 2 * (y / 16)) % 6 == 0) windows.push_back({x, y, 16, 16});
  return windows;
}

double brightness(const Picture& picture, const Picture& mask) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < picture.pixel.size(); ++i) {
    if (mask.pixel[i].w < 0.02f) continue;
    const glm::vec4& c = picture.pixel[i];
    sum += double(c.x + c.y + c.z) / 3;
    ++count;
  }
  EXPECT_GT(count, 10000);
  return sum / count;
}

class Looks : public testing::TestWithParam<Look> {};

TEST_P(Looks, SixteenLayersAreAsBrightAsSixtyFour) {
  const auto mesh = load_model(scene_of(GetParam(), 64).model);
  const auto drawn = [&](int layers, int substeps) {
    Scene scene = scene_of(GetParam(), layers);
    scene.fur.substeps = substeps;
    if (substeps > 1)
      for (const char* assignment : GetParam().with_substeps) apply_set(scene, assignment);
    EXPECT_EQ(scene.image.width, 800);
    EXPECT_EQ(scene.image.height, 600);
    reference::Options options;
    options.windows = sample(scene.image);
    return reference::render(*prepare(scene, mesh), options);
  };
  const Picture sixty_four = drawn(64, 1);
  const double many = brightness(sixty_four, sixty_four);
  for (const int substeps : {1, 4}) {
    const double few = brightness(drawn(16, substeps), sixty_four);
    EXPECT_NEAR(few / many, 1.0, 0.025) << many << " and " << few << " with " << substeps << " sub-steps";
  }
}

INSTANTIATE_TEST_SUITE_P(Examples, Looks,
                         testing::Values(Look{"straight", {}, {}}, Look{"wavy", {}, {}},
                                         Look{"large-curls", {"curl.radius=0.032", "curl.turns=1.1"}, {}},
                                         Look{"small-curls", {}, {}}, Look{"dry", {}, {}},
                                         Look{"wet", {}, {}},
                                         Look{"grass", {}, {"fur.sweep=0.25", "fur.bend=12"}}),
                         [](const auto& param) {
                           std::string name = param.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace pelage
