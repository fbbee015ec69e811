// Tests that the scenes of examples/ are as bright with 16 layers as with 64.
#include <gtest/gtest.h>

#include <filesystem>

#include "harness/prepare/prepare.hpp"
#include "harness/scene/scene_toml.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"

namespace pelage {
namespace {

struct Look {
  const char* name;
  std::vector<const char*> with_16;        ///< settings that the scene file recommends for 16 layers
  std::vector<const char*> with_substeps;  ///< additional settings for 16 layers with four sub-steps
};

Scene scene_of(const Look& look, int layers) {
  Scene scene =
      read_scene(std::filesystem::path(PELAGE_SOURCE_DIR) / "examples" / (std::string(look.name) + ".toml"));
  scene.fur.layers = layers;
  if (layers == 16)
    for (const char* assignment : look.with_16) apply_set(scene, assignment);
  check_scene(scene);
  return scene;
}

double mean_brightness(const Picture& picture, const Picture& mask) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < picture.pixel.size(); ++i) {
    if (mask.pixel[i].w < 0.02f) continue;
    const glm::vec4& c = picture.pixel[i];
    sum += double(c.x + c.y + c.z) / 3;
    ++count;
  }
  EXPECT_GT(count, 60000);
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
    Shells shells(pictures::device(), prepare(scene, mesh), {});
    shells.advance(frames_before(scene.dynamics));
    shells.frame();
    return shells.read();
  };
  const Picture sixty_four = drawn(64, 1);
  const double many = mean_brightness(sixty_four, sixty_four);
  for (const int substeps : {1, 4}) {
    const double few = mean_brightness(drawn(16, substeps), sixty_four);
    EXPECT_NEAR(few / many, 1.0, 0.025) << many << " and " << few << " with " << substeps << " sub-steps";
  }
}

INSTANTIATE_TEST_SUITE_P(Examples, Looks,
                         testing::Values(Look{"straight", {}, {}}, Look{"wavy", {}, {}},
                                         Look{"large-curls", {"curl.radius=0.032", "curl.turns=1.1"}, {}},
                                         Look{"small-curls", {}, {}}, Look{"dry", {}, {}},
                                         Look{"wet", {}, {}},
                                         Look{"grass", {}, {"fur.sweep=0.25", "fur.bend=12"}}),
                         test::by_parameter);

}  // namespace
}  // namespace pelage
