// Tests blend.faces: fur of the far side must not cover fur of the near side (docs/shells.md, section 5).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "harness/error.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/shells/reference/reference.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using namespace pictures;

/// A torus with upright fur. Droplets cover the side that faces the eye. If `both`, droplets also cover the
/// far side.
std::shared_ptr<const FrameInput> torus_wet_in_front(const char* faces, bool both) {
  Scene scene = synthetic::lively_scene();
  scene.blend.faces = faces;
  scene.shading.model = "wet";
  scene.curl.radius = 0;
  scene.fur.length = .15f;
  scene.fur.layers = 12;
  scene.wetness.size = 256;
  scene.wetness.seams = "ignored";
  // With "consistent", fur at the silhouette depends on clumps within a pixel's footprint, which is large
  // there.
  scene.clump.cells = "separate";
  scene.image.width = 80;
  scene.image.height = 60;
  FrameInput input = synthetic::frame(scene, synthetic::torus(), 60, 36, 600);
  const glm::vec3 eye(input.camera.eye);
  std::erase_if(input.droplets, [&](const Droplet& drop) {
    // The outward direction at a point of the torus whose circle has the radius 0.7 in the plane y = 0.
    const glm::vec3 ring = .7f * glm::normalize(glm::vec3(drop.point.x, 0, drop.point.z));
    const float towards = glm::dot(glm::normalize(drop.point - ring), glm::normalize(eye - drop.point));
    // No disc of a droplet on the far side reaches the near side.
    return !(towards > 0 || (both && towards < -0.6f));
  });
  return std::make_shared<FrameInput>(std::move(input));
}

struct FarSide {
  double rim = 0,
         inside = 0;  ///< mean change of a channel where the base does not cover the pixel, and where it does
};

/// Returns how the picture changes if the side that the eye does not see gets wet.
FarSide change_by_the_far_side(const char* faces, const std::string& mapping) {
  const auto near = torus_wet_in_front(faces, false), both = torus_wet_in_front(faces, true);
  EXPECT_LT(near->droplets.size() + 20, both->droplets.size());
  const Picture first = drawn_by_device(near, mapping), second = drawn_by_device(both, mapping);
  FrameInput base = *near;
  base.scene.fur.length = 1e-3f;
  const Picture shape = drawn_by_device(std::make_shared<FrameInput>(base), mapping);
  FarSide change;
  std::size_t rim = 0, inside = 0;
  for (std::size_t i = 0; i < first.pixel.size(); ++i) {
    if (!(first.pixel[i].w > 0.1f)) continue;
    const glm::vec3 d = glm::abs(glm::vec3(first.pixel[i]) - glm::vec3(second.pixel[i]));
    const double mean = double(d.x + d.y + d.z) / 3;
    const bool covered = shape.pixel[i].w == 1;
    (covered ? inside : rim) += 1;
    (covered ? change.inside : change.rim) += mean;
  }
  EXPECT_GT(rim, 125u);
  EXPECT_GT(inside, 500u);
  return {change.rim / double(rim), change.inside / double(inside)};
}

struct FacesOf : testing::TestWithParam<std::string> {};

TEST_P(FacesOf, TheFarSideDoesNotCoverTheNearSide) {
  const FarSide all = change_by_the_far_side("all", GetParam());
  const FarSide front = change_by_the_far_side("front", GetParam());
  const FarSide both = change_by_the_far_side("back-then-front", GetParam());
  RecordProperty("rim_all", std::to_string(all.rim));
  RecordProperty("rim_back_then_front", std::to_string(both.rim));
  EXPECT_EQ(front.rim, 0);
  EXPECT_EQ(front.inside, 0);
  EXPECT_GT(all.rim, 0.01);
  EXPECT_LT(both.rim, all.rim);  // the far side still shows beyond the near strands
  EXPECT_LT(both.inside, all.inside + 1e-9);
}

/// The pops in pictures of a bunny. From one picture to the next, the camera turns around it by half a
/// degree.
struct Turn {
  /// Share of the pixels of a picture that pop: one of their channels is by more than .2 off the mean of the
  /// pictures before and after. Mean over the pictures, and largest.
  double mean = 0, worst = 0;
};

Turn turn_of(const char* faces) {
  Scene scene = model_frame("bunny", 16, "wet")->scene;
  scene.blend.faces = faces;
  scene.camera.framed = false;
  scene.image.width = 240;
  scene.image.height = 180;
  const auto at = [&](int picture) {
    const float angle = glm::radians(.5f * float(picture));
    scene.camera.eye = {3.2f * std::sin(angle), .6f, 3.2f * std::cos(angle)};
    return scene;
  };
  auto input = std::shared_ptr<const FrameInput>(prepare(at(0), load_model("bunny")));
  Shells shells(device(), input, {"tile", {}});
  shells.advance(frames - 1);
  shells.frame();
  std::vector<Picture> pictures;
  for (int picture = 0; picture < 60; ++picture) {
    input = with_view(*input, at(picture), {});
    shells.set_view(input);
    shells.still();
    pictures.push_back(shells.read());
  }
  Turn turn;
  for (std::size_t i = 1; i + 1 < pictures.size(); ++i) {
    std::size_t popping = 0;
    for (std::size_t k = 0; k < pictures[i].pixel.size(); ++k) {
      const glm::vec4 off =
          pictures[i].pixel[k] - 0.5f * (pictures[i - 1].pixel[k] + pictures[i + 1].pixel[k]);
      popping += std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) > 0.2f;
    }
    const double share = double(popping) / double(pictures[i].pixel.size());
    turn.mean += share / double(pictures.size() - 2);
    turn.worst = std::max(turn.worst, share);
  }
  return turn;
}

// A triangle that begins to face the eye moves to another place in the order of drawing. This must not be
// visible as a jump.
TEST(Facing, ATurningBunnyPopsNoMoreThanInTheMeshsOrder) {
  const Turn all = turn_of("all"), both = turn_of("back-then-front");
  RecordProperty("all", fmt::format("{} {}", all.mean, all.worst));
  RecordProperty("back_then_front", fmt::format("{} {}", both.mean, both.worst));
  EXPECT_GT(all.mean, 0) << "the fur moves too little to pop";
  EXPECT_LE(both.mean, all.mean);
  EXPECT_LE(both.worst, all.worst);
}

INSTANTIATE_TEST_SUITE_P(Device, FacesOf, testing::ValuesIn(mappings()), test::by_parameter);

// Tests blend.order "depth": the fragments of a pixel are blended by depth (docs/shells.md, section 5).

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

struct DepthOrder : testing::TestWithParam<std::tuple<const char*, float>> {};

// The mapping "tile" does not draw this order; the mapping "group" replaces it.
TEST_P(DepthOrder, LooksLikeTheReference) {
  const auto [faces, density] = GetParam();
  const auto input = torus(faces, density);
  const Picture expected = drawn_by_reference(*input), drawn = drawn_by_device(input, "tile");
  EXPECT_TRUE(same(expected, drawn, 3000));
  EXPECT_TRUE(same_bits(drawn, drawn_by_device(input, "group")));
  EXPECT_TRUE(same(expected, drawn_by_device(input, "pixel"), 3000));
  EXPECT_GT(change(drawn, drawn_by_device(torus(faces, density, "layer"), "tile")).most, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Torus, DepthOrder,
                         testing::Combine(testing::Values("all", "front", "back-then-front"),
                                          testing::Values(1.0f)));
INSTANTIATE_TEST_SUITE_P(Full, DepthOrder,
                         testing::Combine(testing::Values("all", "front", "back-then-front"),
                                          testing::Values(0.1f)));

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
