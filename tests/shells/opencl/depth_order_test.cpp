// Tests blend.order "depth": the fragments of a pixel are blended by depth (docs/shells.md, section 5).
#include <gtest/gtest.h>

#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "harness/shells/reference/reference.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace pictures;
using reference::Mutant;

/// A torus that hides a part of itself. With thin fur, a pixel has up to a hundred fragments before it is
/// opaque.
std::shared_ptr<const FrameInput> torus(const char* faces, float density = 1, const char* order = "depth") {
  Scene scene = synthetic::lively_scene();
  scene.blend.faces = faces;
  scene.blend.order = order;
  scene.shading.model = "wet";
  scene.fur.layers = 24;
  scene.fur.density = density;
  scene.image.width = 120;
  scene.image.height = 90;
  return std::make_shared<FrameInput>(synthetic::frame(scene, synthetic::torus(), 36, 24, 60));
}

void expect_agreement_of(const Picture& expected, const Picture& drawn, std::size_t least_pixels) {
  const Agreement agreement = compare(expected, drawn);
  EXPECT_TRUE(within(agreement)) << describe(agreement);
  EXPECT_GT(agreement.pixels, least_pixels);
}

struct DepthOrder : testing::TestWithParam<std::tuple<const char*, float>> {};

// The mapping "tile" does not draw this order; the mapping "group" replaces it.
TEST_P(DepthOrder, LooksLikeTheReference) {
  const auto [faces, density] = GetParam();
  const auto input = torus(faces, density);
  const Picture expected = drawn_by_reference(*input), drawn = drawn_by_device(input, "tile");
  expect_agreement_of(expected, drawn, 3000);
  EXPECT_TRUE(same_bits(drawn, drawn_by_device(input, "group")));
  expect_agreement_of(expected, drawn_by_device(input, "pixel"), 3000);
  EXPECT_GT(change(drawn, drawn_by_device(torus(faces, density, "layer"), "tile")).most, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Torus, DepthOrder,
                         testing::Combine(testing::Values("all", "front", "back-then-front"),
                                          testing::Values(1.0f, 0.1f)));

TEST(DepthOrders, OfFacesThatAreAllDrawnAreOnePicture) {
  EXPECT_TRUE(
      same_bits(drawn_by_device(torus("all"), "pixel"), drawn_by_device(torus("back-then-front"), "pixel")));
}

// The picture does not depend on the order of the triangles in the mesh.
TEST(DepthOrders, DoNotDependOnTheMeshsOrder) {
  const auto depth = torus("all"), layer = torus("all", 1, "layer");
  EXPECT_TRUE(same_bits(drawn_by_reference(*depth, Mutant::none),
                        drawn_by_reference(*depth, Mutant::triangles_reversed)));
  EXPECT_GT(
      change(drawn_by_reference(*layer, Mutant::none), drawn_by_reference(*layer, Mutant::triangles_reversed))
          .most,
      0.05);
}

// A square with upright fur, seen from above: no two fragments of a pixel are of one layer, and a layer
// farther outside is nearer.
TEST(DepthOrders, OfASquareFromAboveIsTheOrderOfItsLayers) {
  Scene scene = synthetic::lively_scene();
  scene.dynamics.wind.strength = 0;
  scene.dynamics.gravity = {0, 0, 0};
  scene.fur.comb = scene.fur.comb_noise = 0;
  scene.camera.eye = {0, .01f, 3};
  scene.camera.target = {0, 0, 0};
  scene.fur.layers = 20;
  FrameInput input = synthetic::frame(scene, synthetic::square(6), 6, 6, 30);
  const Picture layers = drawn_by_device(std::make_shared<FrameInput>(input), "pixel");
  input.scene.blend.order = "depth";
  EXPECT_TRUE(same_bits(drawn_by_device(std::make_shared<FrameInput>(input), "pixel"), layers));
}

TEST(DepthOrders, NeedAllLayersInOnePass) {
  const std::string said = test::refusal([&] {
    const Shells shells(device(), torus("all"), {"pixel", {}, 8});
  });
  EXPECT_NE(said.find("only 8 of 24 layers fit in one pass"), std::string::npos) << said;
}

TEST(DepthOrders, AreNotRoundedAfterLayers) {
  EXPECT_THROW(drawn_by_reference(*torus("all"), Mutant::none, true), InputError);
}

// The counts of fragments of both orders agree, but for those behind opaque fur.
TEST(DepthOrders, CountTheSameCoveredFragments) {
  const auto tally = [](const char* order) {
    Shells shells(device(), torus("all", 1, order), {"pixel", {}});
    shells.frame();
    EXPECT_EQ(shells.count(), shells.tally(1).covered);
    return shells.tally(1);
  };
  const Tally depth = tally("depth"), layer = tally("layer");
  EXPECT_EQ(depth.covered, layer.covered);
  EXPECT_GT(depth.blended, depth.covered / 20);
}

}  // namespace
}  // namespace pelage
