// Tests the maps of the fur's shape (docs/shells.md, section 8) on the device.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>

#include "harness/compare/checks.hpp"
#include "harness/compare/frame_output.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/shells/reference/layers.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/files.hpp"
#include "tests/support/style_scenes.hpp"

namespace pelage {
namespace {

using namespace pictures;
using namespace style_scenes;

struct Maps : testing::TestWithParam<int> {  // the parameter is fur.substeps
  test::Folder folder;

  static Picture drawn(const std::function<void(Scene&)>& change) {
    return drawn_by_device(small_torus([&](Scene& s) {
                             s.fur.substeps = GetParam();
                             change(s);
                           }),
                           "tile");
  }
  /// Calls visit(k, name) for the index and the name of each of map_keys().
  static void for_each_key(const std::function<void(std::size_t, const char*)>& visit) {
    Scene scene;
    for (std::size_t k = 0; k < map_keys(scene).size(); ++k) visit(k, map_keys(scene)[k].name);
  }
};
struct AllMaps : Maps {};

TEST_P(Maps, OfTheValueOneChangeNoBit) {
  const auto one = write_map(folder.path / "one.exr", 3, 2, [](glm::vec2) { return 1.0f; });
  const Picture expected = drawn([](Scene&) {});
  for_each_key([&](std::size_t k, const char* name) {
    EXPECT_TRUE(same_bits(drawn([&](Scene& s) { map_keys(s)[k].map = one; }), expected)) << name;
  });
}

TEST_P(Maps, OfTheValueOneHalfAreHalfTheKeyBitForBit) {
  const auto half = write_map(folder.path / "half.exr", 3, 2, [](glm::vec2) { return 0.5f; });
  const Picture whole = drawn([](Scene&) {});
  for_each_key([&](std::size_t k, const char* name) {
    const Picture mapped = drawn([&](Scene& s) { map_keys(s)[k].map = half; });
    EXPECT_TRUE(same_bits(mapped, drawn([&](Scene& s) { map_keys(s)[k].value *= 0.5f; }))) << name;
    EXPECT_FALSE(same_bits(mapped, whole)) << name << " has no effect";
  });
}

TEST_P(Maps, LookLikeTheReference) {
  const auto map = write_map(folder.path / "wavy.exr", 32, 16, wavy);
  for_each_key([&](std::size_t k, const char* name) {
    const auto input = small_torus([&](Scene& s) {
      s.fur.substeps = GetParam();
      s.fur.density = 0.9f;
      map_keys(s)[k].map = map;
    });
    EXPECT_TRUE(drawn_alike(input, "tile", 2000)) << name;
  });
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

// Tests colliders that push the fur (docs/colliders.md) on the device.

struct PressedFur : testing::TestWithParam<int> {};

TEST_P(PressedFur, LooksLikeTheReference) {
  const auto input = pressed_fur([&](Scene& s) { s.fur.substeps = GetParam(); });
  const Picture expected = drawn_by_reference(*input);
  for (const std::string& mapping : mappings())
    EXPECT_TRUE(same(expected, drawn_by_device(input, mapping))) << mapping;
  const auto free = long_fur([&](Scene& s) { s.fur.substeps = GetParam(); });
  EXPECT_LT(compare(expected, drawn_by_reference(*free)).psnr, 45) << "the colliders change too little";
}

INSTANTIATE_TEST_SUITE_P(Substeps, PressedFur, testing::Values(1));
INSTANTIATE_TEST_SUITE_P(Full, PressedFur, testing::Values(4));

struct PressedTips : testing::TestWithParam<bool> {};  // true: the mesh turns and deforms

TEST_P(PressedTips, AreTheReferences) {
  const auto input = GetParam() ? kneaded_fur() : pressed_fur();
  Shells shells(device(), input);
  shells.advance(frames);
  std::vector<glm::vec3> expected;
  std::size_t moved = 0;
  const auto free = long_fur();
  for (std::size_t f = 0; f < input->strands.root.size(); ++f) {
    expected.emplace_back(reference::simulate(*input, f, frames).tip);
    if (glm::distance(glm::dvec3(expected.back()), reference::simulate(*free, f, frames).tip) > 1e-3) ++moved;
  }
  const Spread errors = tip_errors(double(input->scene.fur.length), shells.tips(), expected);
  EXPECT_TRUE(check_usual_tip(errors).holds());
  EXPECT_GT(moved, 100u);
}

INSTANTIATE_TEST_SUITE_P(Contact, PressedTips, testing::Bool());

TEST(Contact, WithAMeshThatTurnsAndDeformsLooksLikeTheReference) {
  const auto input = kneaded_fur();
  EXPECT_TRUE(drawn_alike(input, "tile"));
  EXPECT_LT(compare(drawn_by_reference(*input), drawn_by_reference(*pressed_fur())).psnr, 60);
}

// The measure of the depth is the true distance for spheres and capsules, and the field for the mesh.
TEST(Contact, LeavesNoLayerDeeperInsideThanOneSpacing) {
  const auto input = pressed_fur();
  const double time = reference::time_after(input->scene.dynamics, frames);
  const reference::Colliders colliders(input->scene, input->contact_fields, time);
  const reference::Geometry geometry(*input, reference::wetness_mask(*input), frames);
  const auto free_input = long_fur();
  const reference::Geometry free(*free_input, reference::wetness_mask(*free_input), frames);
  const double spacing = double(input->scene.fur.length) / input->scene.fur.layers;
  double deepest = 0, deepest_before = 0;
  std::size_t pushed = 0;
  for (std::size_t slot = 0; slot < geometry.slots(); ++slot) {
    ASSERT_GT(colliders.distance(geometry.position(slot, -1)), 0) << "the base must be outside";
    for (int n = 0; n < input->scene.fur.layers; ++n) {
      deepest = std::max(deepest, -colliders.distance(geometry.position(slot, n)));
      deepest_before = std::max(deepest_before, -colliders.distance(free.position(slot, n)));
      if (glm::distance(geometry.position(slot, n), free.position(slot, n)) > spacing) ++pushed;
    }
  }
  RecordProperty("deepest", fmt::format("{:.3g} R, without contact {:.3g} R, spacing {:.3g} R, {} moved",
                                        deepest, deepest_before, spacing, pushed));
  EXPECT_GT(deepest_before, 3 * spacing);
  EXPECT_GT(pushed, 500u);
  EXPECT_LT(deepest, 1e-3 * spacing);
}

// Colliders push sticks.
struct PressedSticks : testing::TestWithParam<std::tuple<const char*, const char*>> {};  // topology, solver

TEST_P(PressedSticks, AreTheReferences) {
  const auto on_sticks = [](Scene& s) { std::tie(s.dynamics.topology, s.dynamics.solver) = GetParam(); };
  const auto input = kneaded_fur(on_sticks);
  Shells shells(device(), input), free(device(), long_fur(on_sticks));
  shells.advance(frames);
  free.advance(frames);
  const std::vector<glm::vec3> tops = shells.tips(), free_tops = free.tips();
  for (const Check& check : check_sticks(*input, frames, tops))
    EXPECT_TRUE(check.holds()) << check.metric << " " << check.value;
  std::size_t moved = 0;
  for (std::size_t i = 0; i < tops.size(); ++i) moved += glm::distance(tops[i], free_tops[i]) > 1e-2f;
  EXPECT_GT(moved, 100u);
}

INSTANTIATE_TEST_SUITE_P(Contact, PressedSticks,
                         testing::Combine(testing::Values("sticks", "prisms", "separable-prisms"),
                                          testing::Values("backward-euler", "rk4")));
INSTANTIATE_TEST_SUITE_P(Euler, PressedSticks,
                         testing::Values(std::tuple("prisms", "semi-implicit-euler"),
                                         std::tuple("separable-sticks", "predictor-corrector")));

TEST(Contact, WithSticksLooksLikeTheReference) {
  const auto input = pressed_fur([](Scene& s) { s.dynamics.topology = "sticks"; });
  Shells shells(device(), input);
  shells.advance(frames - 1);
  shells.frame();
  EXPECT_TRUE(same(reference_output(*input, frames, false).image, shells.read()));
}

// The colliders arrive, push the fur, and disappear; the fur must return to rest.
TEST(Contact, EndsWithFurAtRest) {
  const auto input = pressed_fur([](Scene& s) {
    s.dynamics.wind.strength = 0;
    s.contact.spheres[0].motion.end = s.contact.capsules[0].motion.end = s.contact.mesh.motion.end = 0.2f;
  });
  const auto at_rest = long_fur([](Scene& s) { s.dynamics.wind.strength = 0; });
  Shells shells(device(), input), free(device(), at_rest);
  shells.advance(11);
  free.advance(11);
  const double length = double(input->scene.fur.length);
  EXPECT_GT(tip_errors(length, shells.tips(), free.tips()).worst, 0.2);
  shells.advance(240);
  free.advance(240);
  EXPECT_LT(tip_errors(length, shells.tips(), free.tips()).worst, tolerance::usual_tip);
  for (const glm::vec3& v : shells.velocities()) EXPECT_LT(glm::length(v), tolerance::velocity);
  shells.frame();
  free.frame();
  EXPECT_GT(compare(shells.read(), free.read()).psnr, tolerance::picture_psnr);
}

TEST(Contact, WithCollidersElsewhereChangesNothing) {
  const auto far = long_fur([](Scene& s) {
    ContactSphereScene sphere;
    sphere.centre = {0, 50, 0};
    s.contact.spheres = {sphere};
  });
  EXPECT_EQ(compare(drawn_by_device(far, "tile"), drawn_by_device(long_fur(), "tile")).worst, 0);
}

TEST(Contact, WithClippedTrianglesLooksLikeTheReference) {
  const auto input = pressed_fur([](Scene& s) {
    s.fur.layers = 8;
    s.camera.framed = false;
    s.camera.eye = {0.74f, .2f, -0.3f};
    s.camera.target = {0.72f, 0.2f, 0.3f};
  });
  EXPECT_TRUE(drawn_alike(input, "tile"));
}

TEST(Contact, InSeveralPassesDrawsTheSamePicture) {
  const auto input = pressed_fur();
  EXPECT_EQ(compare(drawn_by_device(input, "tile"), drawn_with(input, {"tile", {}, 4})).worst, 0);
}

}  // namespace
}  // namespace pelage
