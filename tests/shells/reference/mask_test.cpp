// Tests Algorithm 1, Eq. 5 and Algorithm 2 of paper S with numbers that can be checked by hand.
#include "harness/shells/reference/mask.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "harness/prepare/prepare.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/scene/scene_toml.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace reference;

Droplet droplet(float u, float v, float radius, float wetness) {
  return {{u, v}, radius, wetness, {0, 0, 0}, 100.f};
}

/// Returns a frame with these droplets and with the readings of the papers whose numbers can be checked by
/// hand.
FrameInput with(std::vector<Droplet> droplets, int size = 8) {
  Scene scene = synthetic::lively_scene();
  scene.wetness.blend = "near";
  scene.clump.scale = "literal";
  scene.clump.cells = "separate";
  scene.wetness.size = size;
  FrameInput input = synthetic::frame(scene, synthetic::square(1), 1, 1, 0);
  input.droplets = std::move(droplets);
  return input;
}

const Clump& texel(const Mask& mask, int i, int j) {
  return mask.texel[std::size_t(j) * std::size_t(mask.size) + std::size_t(i)];
}

void expect_clump(const Clump& clump, double u, double v, double radius, double wetness) {
  EXPECT_NEAR(clump.centre.x, u, 1e-6);
  EXPECT_NEAR(clump.centre.y, v, 1e-6);
  EXPECT_NEAR(clump.radius, radius, 1e-6);
  EXPECT_NEAR(clump.wetness, wetness, 1e-6);
}

TEST(ReferenceMask, OneDropletWetsTheTexelsWhoseCentresItsDiscHolds) {
  const Mask mask = wetness_mask(with({droplet(.5f, .25f, .2f, .6f)}));
  int wet = 0;
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 8; ++i) {
      const bool inside = std::hypot((i + .5) / 8 - .5, (j + .5) / 8 - .25) <= .2;
      if (inside) {
        ++wet;
        expect_clump(texel(mask, i, j), .5, .25, .2, .6);
      } else {
        EXPECT_EQ(texel(mask, i, j), Clump{});
      }
    }
  EXPECT_EQ(wet, 12);  // the 4 x 4 texels around the centre without their corners
}

TEST(ReferenceMask, OverlappingDropletsBlendIfTheSceneSaysSo) {
  // The centres are further apart than the second radius. The discs share the texel (4, 4).
  FrameInput input = with({droplet(.5f, .5f, .3f, .4f), droplet(.75f, .5f, .2f, .4f)});
  expect_clump(texel(wetness_mask(input), 4, 4), .75, .5, .2, .4);
  EXPECT_EQ(blended_share(input), 0);
  input.scene.wetness.blend = "overlap";
  const Mask mask = wetness_mask(input);
  expect_clump(texel(mask, 4, 4), .625, .5, .25, .8);
  expect_clump(texel(mask, 6, 4), .75, .5, .2, .4);
  const auto wet =
      std::count_if(mask.texel.begin(), mask.texel.end(), [](const Clump& c) { return c.wetness > 0; });
  const auto mixed =
      std::count_if(mask.texel.begin(), mask.texel.end(), [](const Clump& c) { return c.wetness > 0.5; });
  EXPECT_GT(mixed, 0);
  EXPECT_DOUBLE_EQ(blended_share(input), double(mixed) / double(wet));
}

// Random droplets that are one radius apart are not "near" each other if they are blended in their order, but
// many overlap.
TEST(ReferenceMask, DropletsOfTheWetSceneOverlap) {
  Scene scene = read_scene(std::filesystem::path(PELAGE_SOURCE_DIR) / "examples" / "wet.toml");
  const auto mesh = load_scene_mesh(scene, {});
  EXPECT_GT(blended_share(*prepare(scene, mesh)), 0.1);
  scene.wetness.blend = "near";
  scene.wetness.seams = "ignored";
  scene.clump.cells = "separate";
  scene.wetness.spacing = 1;
  EXPECT_LT(blended_share(*prepare(scene, mesh)), 0.001);
}

TEST(ReferenceMask, CloseDropletsBlend) {
  // By Algorithm 1 of paper S, the wetness is rho = .4 + .4 = .8, and the second droplet has the weight alpha
  // = .4 / .8 = .5. The clump is therefore the mean of both droplets.
  const Mask mask = wetness_mask(with({droplet(.5f, .5f, .3f, .4f), droplet(.6f, .5f, .2f, .4f)}));
  expect_clump(texel(mask, 4, 4), .55, .5, .25, .8);
  expect_clump(texel(mask, 2, 4), .5, .5, .3, .4);  // only the first droplet covers this texel
}

TEST(ReferenceMask, WetnessStopsAtOneAndAlphaFollows) {
  // In Algorithm 1 of paper S, the sum of the wetnesses is .5 + .8 = 1.3. It is clamped to rho = 1. The
  // second droplet then has the weight alpha = .8 / rho = .8.
  const Mask mask = wetness_mask(with({droplet(.5f, .5f, .3f, .5f), droplet(.6f, .5f, .2f, .8f)}));
  expect_clump(texel(mask, 4, 4), .2 * .5 + .8 * .6, .5, .2 * .3 + .8 * .2, 1);
}

TEST(ReferenceMask, ADistantCentreIsOverwritten) {
  // The texel is in both discs, but the first droplet's centre is outside the second droplet's disc. In this
  // case Algorithm 1 of paper S overwrites the texel with the second droplet.
  const Mask mask = wetness_mask(with({droplet(.3f, .55f, .35f, .4f), droplet(.6f, .55f, .2f, .7f)}));
  expect_clump(texel(mask, 4, 4), .6, .55, .2, .7);
}

TEST(ReferenceMask, OrderMatters) {
  const Droplet large = droplet(.3f, .55f, .35f, .4f), small = droplet(.6f, .55f, .2f, .7f);
  const Mask mask = wetness_mask(with({small, large}));
  // The large droplet's disc contains the small droplet's centre, so the droplets blend. By Algorithm 1 of
  // paper S, rho = 1 and the large droplet has the weight alpha = .4.
  expect_clump(texel(mask, 4, 4), .6 * .6 + .4 * .3, .55, .6 * .2 + .4 * .35, 1);
  EXPECT_EQ(wetness_mask(with({large, small}), 1, Mutant::droplets_reversed).texel, mask.texel);
}

TEST(ReferenceMask, ADropletDoesNotReachAForeignSheet) {
  FrameInput input = with({droplet(.5f, .5f, .4f, .5f)});
  input.droplets[0].point = input.mask_surface[4 * 8 + 4];
  input.droplets[0].reach = .3f;
  // The surface points of texel column 3 are moved to z = 1, farther from the droplet than its reach of .3.
  for (int j = 0; j < 8; ++j) input.mask_surface[std::size_t(j) * 8 + 3].z = 1;
  const Mask mask = wetness_mask(input);
  EXPECT_EQ(texel(mask, 4, 4).wetness, .5);
  EXPECT_EQ(texel(mask, 5, 4).wetness, .5);
  EXPECT_EQ(texel(mask, 3, 4).wetness, 0);
}

TEST(ReferenceMask, SamplingIsNearestAndRepeats) {
  Mask mask{4, std::vector<Clump>(16)};
  for (std::size_t i = 0; i < 16; ++i) mask.texel[i].wetness = double(i);
  EXPECT_EQ(mask.nearest({.30, .80}).wetness, 13);
  EXPECT_EQ(mask.nearest({-.70, 2.80}).wetness, 13);
  EXPECT_EQ(mask.nearest({1, 1}).wetness, 0);
  EXPECT_EQ(mask.nearest({.99999999999, 0}).wetness, 3);
  EXPECT_EQ(mask.nearest({-1e-30, 0}).wetness, 3);  // u - floor(u) rounds to 1; the last texel is used
}

TEST(ReferenceClump, ShapeIsZeroOnTheFirstLayerAndOneOnTheLast) {
  for (const int layers : {2, 16, 64}) {
    EXPECT_NEAR(clump_shape(1.0 / layers, 1, layers), 0, 1e-15);
    for (const double w : {0.0, .3, 1.0}) EXPECT_NEAR(clump_shape(1, w, layers), 1, 1e-15);
    double before = -1;
    for (int n = 0; n < layers; ++n) {
      const double h = (1.0 + n) / layers;
      EXPECT_NEAR(clump_shape(h, 0, layers), h, 1e-15);
      const double f = clump_shape(h, .7, layers);
      EXPECT_GE(f, 0);
      EXPECT_LE(f, 1 + 1e-15);
      EXPECT_GT(f, before);
      before = f;
    }
  }
  EXPECT_NEAR(clump_shape(.25, 1, 16), .5, 1e-15);  // ln 4 = ln 16 / 2
}

// The three vertices of Bruderlin's hair move by h + w (1-h) of the way to the centre; the root stays.
TEST(ReferenceClump, TheRateMovesThreeVertices) {
  for (const double w : {0.0, .4, 1.0}) {
    EXPECT_EQ(clump_shape(0, w, 16, "rate"), 0);
    for (const double h : {1.0 / 3, 2.0 / 3, 1.0})
      EXPECT_NEAR(clump_shape(h, w, 16, "rate"), h + w * (1 - h), 1e-14);
    EXPECT_NEAR(clump_shape(1.0 / 6, w, 16, "rate"), (1 + 2 * w) / 6, 1e-14);
    EXPECT_NEAR(clump_shape(.5, w, 16, "rate"), .5 + .5 * w, 1e-14);
    double before = 0;
    for (int n = 1; n <= 512; ++n) {
      const double f = clump_shape(n / 512.0, w, 512, "rate");
      EXPECT_GE(f, before - 1e-15);
      EXPECT_LE(f, 1 + 1e-15);
      before = f;
    }
  }
}

// Only the half texel around a disc is outside it, so the share halves as the texels do.
TEST(ReferenceClump, DiscardsAreTheTwoTestsOfAlgorithm2) {
  const auto shares = [](int size, float gain, std::size_t most = 1'000'000'000) {
    FrameInput input = with({droplet(.5f, .5f, .3f, .6f)}, size);
    input.scene.clump.cells = "literal";
    input.scene.clump.gain = gain;
    return discards(input, 1, most);
  };
  const Discards coarse = shares(64, 1), fine = shares(128, 1);
  EXPECT_GT(coarse.outside, .003);
  EXPECT_LT(coarse.outside, .03);
  EXPECT_NEAR(fine.outside / coarse.outside, .5, .1);
  const Discards sampled = shares(128, 1, 50'000);  // of a million places
  EXPECT_NEAR(sampled.outside, fine.outside, .1 * fine.outside);
  EXPECT_NEAR(sampled.dry, fine.dry, .05 * fine.dry);
  EXPECT_GT(fine.dry, .01);  // Eq. 5 with r in UV moves the fur at the border of the disc by up to 5% of r
  EXPECT_LT(fine.dry, .2);
  EXPECT_GT(shares(64, 256).dry, 2 * fine.dry);
  EXPECT_EQ(shares(64, 0).dry, 0);
}

/// A mask with one clump: centre (.5, .5), radius .2, wetness .5.
struct OneClump : testing::Test {
  FrameInput input = with({droplet(.5f, .5f, .2f, .5f)}, 64);
  Mask mask = wetness_mask(input);
  OneClump() { input.scene.clump = {0, "logarithmic", 10, "literal", "separate"}; }
};

TEST_F(OneClump, DryFurStays) {
  const Displacement dry = clump_displacement(input, mask, {.1, .1}, 7);
  EXPECT_FALSE(dry.discarded);
  EXPECT_EQ(dry.d, glm::dvec2(0));
  EXPECT_EQ(dry.delta_d, glm::dvec2(0));
  EXPECT_EQ(dry.wetness, 0);
}

TEST_F(OneClump, TheDisplacementIsEquation5) {
  // In Eq. 5 of paper S, the displacement d is the vector from the clump's centre to the fragment, multiplied
  // by f, by the wetness rho and by the clump's radius .2, here in tenths of a UV unit (clump.gain = 10).
  // With f = h = 8/16 and rho = .5, d is half of this vector. The texture lookup moves away from the centre,
  // so the drawn fur moves towards the centre.
  const Displacement tenths = clump_displacement(input, mask, {.56, .53}, 7);
  EXPECT_NEAR(tenths.d.x, .5 * .06, 1e-7);
  EXPECT_NEAR(tenths.d.y, .5 * .03, 1e-7);
  EXPECT_NEAR(tenths.delta_d.x, .06 / 16, 1e-7);
  EXPECT_FALSE(tenths.discarded);
  // With clump.gain = 1, the radius is in UV units.
  input.scene.clump.gain = 1;
  EXPECT_NEAR(clump_displacement(input, mask, {.56, .53}, 7).d.x, .5 * .5 * .2 * .06, 1e-8);
  // If clump.shape is 1, the displacement d is 0 on the first layer. delta_d is d on this layer minus d on
  // the base surface. On the base surface d is 0, so delta_d is also 0.
  input.scene.clump.shape = 1;
  EXPECT_NEAR(clump_displacement(input, mask, {.56, .53}, 0).delta_d.x, 0, 1e-15);
  input.scene.clump.shape = .5f;
  const Displacement first = clump_displacement(input, mask, {.56, .53}, 0);
  EXPECT_EQ(first.delta_d, first.d);
  EXPECT_NEAR(first.d.x, .5 / 16 * .5 * .2 * .06, 1e-9);
}

TEST_F(OneClump, Algorithm2DiscardsWhatLooksIntoDryFur) {
  // On the outermost layer, f = 1 in Eq. 5 of paper S. The wetness rho times the clump's radius times
  // clump.gain is also 1. Let p be the fragment's position. The displacement d is then the vector from the
  // clump's centre to p, and the displaced point p + d is twice as far from the clump's centre as p.
  EXPECT_FALSE(clump_displacement(input, mask, {.59, .5}, 15).discarded);
  EXPECT_TRUE(clump_displacement(input, mask, {.62, .5}, 15).discarded);
  EXPECT_FALSE(clump_displacement(input, mask, {.62, .5}, 3).discarded);
}

TEST_F(OneClump, Algorithm2DiscardsOutsideTheRadius) {
  for (Clump& clump : mask.texel)
    if (clump.wetness > 0) clump.radius = .05;
  EXPECT_FALSE(clump_displacement(input, mask, {.54, .5}, 0).discarded);
  EXPECT_TRUE(clump_displacement(input, mask, {.56, .5}, 0).discarded);
}

TEST(ReferenceClump, SeparateCellsDoNotFillEachOthersGaps) {
  // The mask has two clumps of equal radius. The second clump overwrites the first clump where their discs
  // overlap.
  FrameInput input = with({droplet(.4f, .5f, .12f, .5f), droplet(.6f, .5f, .12f, .5f)}, 64);
  input.scene.clump = {0, "logarithmic", 2 / .12f, "literal", "separate"};
  const Mask mask = wetness_mask(input);
  // On the outermost layer, the first clump displaces the fragment at p by d = (.05, 0) to (.5, .5), a point
  // of the second clump. With clump.cells = "separate", the fragment must be discarded. With "literal", it
  // must not be discarded.
  const glm::dvec2 p(.45, .5);
  EXPECT_TRUE(clump_displacement(input, mask, p, 15).discarded);
  input.scene.clump.cells = "literal";
  EXPECT_FALSE(clump_displacement(input, mask, p, 15).discarded);
}

}  // namespace
}  // namespace pelage
