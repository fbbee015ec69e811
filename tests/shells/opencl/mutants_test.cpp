// Tests that the comparison of the device's pictures with the reference detects mistakes. Each test plants
// one deliberate mistake (a mutant) in the reference. The comparison must then fail for both scenes of this
// file. Without a mistake the comparison must pass.
#include <gtest/gtest.h>

#include "tests/shells/opencl/picture_scenes.hpp"

namespace pelage {
namespace {

using reference::Mutant;

struct Planted {
  const char* name;
  Mutant mutant;
};

constexpr Planted planted[] = {
    {"layer_missing", Mutant::layer_missing},
    {"height_without_one", Mutant::height_without_one},
    {"triangles_reversed", Mutant::triangles_reversed},
    {"front_faces_culled", Mutant::front_faces_culled},
    {"uv_swapped", Mutant::uv_swapped},
    {"mask_bilinear", Mutant::mask_bilinear},
    {"droplets_reversed", Mutant::droplets_reversed},
    {"log_negated", Mutant::log_negated},
};

/// Mistakes in the light of wet fur, in addition.
constexpr Planted planted_wet[] = {
    {"tangent_reversed", Mutant::tangent_reversed},
    {"eye_reversed", Mutant::eye_reversed},
    {"facing_swapped", Mutant::facing_swapped},
};

/// Returns the frame with the values of pelage's first version.
std::shared_ptr<const FrameInput> with_first_readings(FrameInput input) {
  input.scene.blend.faces = "all";
  input.scene.clump.scale = "relative";
  input.scene.clump.cells = "separate";
  input.scene.shading.tangent = "paper";
  input.scene.wetness.blend = "near";
  return std::make_shared<FrameInput>(std::move(input));
}

/// The scenes and the device's pictures of them. The device draws each scene once, and all mutants are
/// compared with that picture.
struct Scenes {
  std::shared_ptr<const FrameInput> small, torus;
  Picture small_drawn = pictures::drawn_by_device(small, "tile");
  Picture torus_drawn = pictures::drawn_by_device(torus, "tile");
};

template <int suite>
struct MutantsOf : testing::TestWithParam<Planted> {
  static std::unique_ptr<Scenes> scenes;
  static void TearDownTestSuite() { scenes.reset(); }
  static void expect_seen(Mutant mutant) {
    expect_seen(drawn(*scenes->small, mutant), scenes->small_drawn, 5000);
    expect_seen(drawn(*scenes->torus, mutant), scenes->torus_drawn, 20000);
  }
  static Picture drawn(const FrameInput& input, Mutant mutant) {
    return pictures::drawn_by_reference(input, mutant);
  }
  static void expect_seen(const Picture& mistaken, const Picture& drawn, std::size_t least_pixels) {
    const Agreement agreement = compare(mistaken, drawn);
    EXPECT_GT(agreement.pixels, least_pixels);
    EXPECT_FALSE(within(agreement)) << pictures::describe(agreement);
  }
};
template <int suite>
std::unique_ptr<Scenes> MutantsOf<suite>::scenes;

struct Mutants : MutantsOf<0> {
  static void SetUpTestSuite() {
    scenes =
        std::make_unique<Scenes>(Scenes{with_first_readings(*pictures::small_frame("curling")),
                                        with_first_readings(*pictures::model_frame("torus", 16, "curling"))});
  }
};

TEST_P(Mutants, AreSeen) {
  expect_seen(GetParam().mutant);
}

/// The same under the wet model, with the default readings.
struct WetMutants : MutantsOf<1> {
  static void SetUpTestSuite() {
    scenes = std::make_unique<Scenes>(
        Scenes{pictures::small_frame("wet"), pictures::model_frame("torus", 16, "wet")});
  }
};

TEST_P(WetMutants, AreSeen) {
  // With blend.faces "back-then-front", no two fragments of one layer of the torus that face the same way lie
  // on one pixel, so the order of the triangles has no effect there.
  if (GetParam().mutant == Mutant::triangles_reversed)
    expect_seen(drawn(*scenes->small, GetParam().mutant), scenes->small_drawn, 5000);
  else
    expect_seen(GetParam().mutant);
}

const auto name_of = [](const auto& given) { return std::string(given.param.name); };
INSTANTIATE_TEST_SUITE_P(Planted, Mutants, testing::ValuesIn(planted), name_of);
INSTANTIATE_TEST_SUITE_P(Planted, WetMutants, testing::ValuesIn(planted), name_of);
INSTANTIATE_TEST_SUITE_P(PlantedInWetFur, WetMutants, testing::ValuesIn(planted_wet), name_of);

// W Eq. 3 and 5: a reference that ignores one of the constants sigma.
struct WetConstants : WetMutants {};

TEST_F(WetConstants, AreSeen) {
  for (float ShadingScene::*sigma :
       {&ShadingScene::occlusion, &ShadingScene::darkening, &ShadingScene::wet_specular})
    for (const auto& [input, drawn] :
         {std::pair(scenes->small, scenes->small_drawn), std::pair(scenes->torus, scenes->torus_drawn)}) {
      FrameInput mistaken = *input;
      EXPECT_GT(mistaken.scene.shading.*sigma, 0.1f);
      mistaken.scene.shading.*sigma = 0;
      expect_seen(WetMutants::drawn(mistaken, Mutant::none), drawn, 5000);
    }
}

TEST_F(WetConstants, TheOriginalPasses) {
  EXPECT_TRUE(pictures::same(WetMutants::drawn(*scenes->torus, Mutant::none), scenes->torus_drawn));
}

TEST(MutantsControl, TheOriginalPasses) {
  EXPECT_TRUE(pictures::drawn_alike(pictures::small_frame("curling"), "tile"));
}

}  // namespace
}  // namespace pelage
