// Tests the maps of the fur's shape (docs/shells.md, section 8) on the device.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/files.hpp"
#include "tests/support/style_scenes.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;
using namespace pictures;
using namespace style_scenes;

/// A map of a scene, and the scalar key that it multiplies.
struct MapKey {
  const char* name;
  fs::path& (*map)(Scene&);
  float& (*value)(Scene&);
};

const MapKey keys[] = {
    {"length", [](Scene& s) -> fs::path& { return s.fur.length_map; },
     [](Scene& s) -> float& { return s.fur.length; }},
    {"density", [](Scene& s) -> fs::path& { return s.fur.density_map; },
     [](Scene& s) -> float& { return s.fur.density; }},
    {"comb", [](Scene& s) -> fs::path& { return s.fur.comb_map; },
     [](Scene& s) -> float& { return s.fur.comb; }},
    {"radius", [](Scene& s) -> fs::path& { return s.curl.radius_map; },
     [](Scene& s) -> float& { return s.curl.radius; }},
    {"turns", [](Scene& s) -> fs::path& { return s.curl.turns_map; },
     [](Scene& s) -> float& { return s.curl.turns; }},
};

/// Returns the torus with wavy maps of all keys.
std::shared_ptr<const FrameInput> with_all_maps(const std::function<void(Scene&)>& change) {
  const test::Folder folder;
  const auto map = write_map(folder.path / "wavy.exr", 32, 16, wavy);
  return small_torus([&](Scene& s) {
    for (const MapKey& key : keys) key.map(s) = map;
    change(s);
  });
}

struct Maps : testing::TestWithParam<int> {  // the parameter is fur.substeps
  test::Folder folder;

  static Picture drawn(const std::function<void(Scene&)>& change) {
    return drawn_by_device(small_torus([&](Scene& s) {
                             s.fur.substeps = GetParam();
                             change(s);
                           }),
                           "tile");
  }
};
struct AllMaps : Maps {};

TEST_P(Maps, OfTheValueOneChangeNoBit) {
  const auto one = write_map(folder.path / "one.exr", 3, 2, [](glm::vec2) { return 1.0f; });
  const Picture expected = drawn([](Scene&) {});
  for (const MapKey& key : keys)
    EXPECT_TRUE(same_bits(drawn([&](Scene& s) { key.map(s) = one; }), expected)) << key.name;
}

TEST_P(Maps, OfTheValueOneHalfAreHalfTheKeyBitForBit) {
  const auto half = write_map(folder.path / "half.exr", 3, 2, [](glm::vec2) { return 0.5f; });
  const Picture whole = drawn([](Scene&) {});
  for (const MapKey& key : keys) {
    const Picture mapped = drawn([&](Scene& s) { key.map(s) = half; });
    EXPECT_TRUE(same_bits(mapped, drawn([&](Scene& s) { key.value(s) *= 0.5f; }))) << key.name;
    EXPECT_FALSE(same_bits(mapped, whole)) << key.name << " has no effect";
  }
}

TEST_P(Maps, LookLikeTheReference) {
  const auto map = write_map(folder.path / "wavy.exr", 32, 16, wavy);
  for (const MapKey& key : keys) {
    const auto input = small_torus([&](Scene& s) {
      s.fur.substeps = GetParam();
      s.fur.density = 0.9f;
      key.map(s) = map;
    });
    EXPECT_TRUE(drawn_alike(input, "tile", 2000)) << key.name;
  }
}

// All maps in one scene, because every further program takes seconds to compile.
TEST_P(AllMaps, TogetherLookLikeTheReferenceInAllMappings) {
  const auto input = with_all_maps([](Scene& s) {
    s.fur.substeps = GetParam();
    s.fur.density = 0.9f;
  });
  const Picture expected = drawn_by_reference(*input);
  for (const std::string& mapping : mappings())
    EXPECT_TRUE(same(expected, drawn_by_device(input, mapping), 2000)) << mapping;
}

INSTANTIATE_TEST_SUITE_P(Substeps, Maps, testing::Values(1));
INSTANTIATE_TEST_SUITE_P(Full, Maps, testing::Values(4));
INSTANTIATE_TEST_SUITE_P(Substeps, AllMaps, testing::Values(4));
INSTANTIATE_TEST_SUITE_P(Full, AllMaps, testing::Values(1));

// An eye inside the fur, so that triangles are clipped.
TEST(MapsOfClippedFur, LookLikeTheReference) {
  const auto input = with_all_maps([](Scene& s) {
    s.fur.layers = 8;
    s.camera.framed = false;
    s.camera.eye = {1.05f, .04f, 0};
    s.camera.target = {0, 0, 0};
  });
  EXPECT_TRUE(drawn_alike(input, "tile"));
}

TEST(MapsOfSeparateTriangles, LookLikeTheReference) {
  EXPECT_TRUE(drawn_alike(with_all_maps([](Scene& s) { s.fur.binding = "separate"; }), "tile"));
}

TEST(MapOfTheLength, LimitsTheMovingStrands) {
  const test::Folder folder;
  const auto map = write_map(folder.path / "wavy.exr", 32, 16, wavy);
  const auto input = small_torus([&](Scene& s) { s.fur.length_map = map; });
  Shells shells(device(), input);
  shells.advance(frames);
  const std::vector<glm::vec3> tips = shells.tips();
  float shortest = 1, longest = 0;
  for (std::size_t f = 0; f < tips.size(); ++f) {
    const float length = input->scene.fur.length * input->style.length[f];
    EXPECT_LE(glm::length(tips[f]), length * (1 + 1e-6f));
    shortest = std::min(shortest, glm::length(tips[f]));
    longest = std::max(longest, glm::length(tips[f]));
  }
  EXPECT_LT(shortest, 0.3f * longest);
}

}  // namespace
}  // namespace pelage
