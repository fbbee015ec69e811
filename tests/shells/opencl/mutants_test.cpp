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

/// The scenes and the device's pictures of them. The device draws each scene once, and all mutants are
/// compared with that picture.
struct Scenes {
  std::shared_ptr<const FrameInput> small = pictures::small_frame("curling");
  Picture small_drawn = pictures::drawn_by_device(small, "tile");
  std::shared_ptr<const FrameInput> torus = pictures::model_frame("torus", 16, "curling");
  Picture torus_drawn = pictures::drawn_by_device(torus, "tile");
};

struct Mutants : testing::TestWithParam<Planted> {
  static std::unique_ptr<Scenes> scenes;
  static void SetUpTestSuite() { scenes = std::make_unique<Scenes>(); }
  static void TearDownTestSuite() { scenes.reset(); }
};
std::unique_ptr<Scenes> Mutants::scenes;

TEST_P(Mutants, AreSeen) {
  const Agreement small =
      compare(pictures::drawn_by_reference(*scenes->small, GetParam().mutant), scenes->small_drawn);
  EXPECT_GT(small.pixels, 5000u);
  EXPECT_FALSE(within(small)) << pictures::describe(small);
  const Agreement torus =
      compare(pictures::drawn_by_reference(*scenes->torus, GetParam().mutant), scenes->torus_drawn);
  EXPECT_GT(torus.pixels, 20000u);
  EXPECT_FALSE(within(torus)) << pictures::describe(torus);
}

INSTANTIATE_TEST_SUITE_P(Planted, Mutants, testing::ValuesIn(planted),
                         [](const auto& given) { return std::string(given.param.name); });

TEST(MutantsControl, TheOriginalPasses) {
  const auto input = pictures::small_frame("curling");
  const Agreement agreement =
      compare(pictures::drawn_by_reference(*input), pictures::drawn_by_device(input, "tile"));
  EXPECT_TRUE(within(agreement)) << pictures::describe(agreement);
}

}  // namespace
}  // namespace pelage
