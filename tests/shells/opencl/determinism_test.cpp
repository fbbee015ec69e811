// The mapping `tile` divides the picture into tiles and processes the layers in batches. This file tests that
// `tile` draws a scene with the same bits in every run, with any tile size, and with any number of layers per
// batch (GROUP). The file also compares the pictures of the mappings `tile` and `pixel`.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <set>

#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace pictures;

// The value of each tuning axis (a compile-time option of the kernels), by the name of the axis.
using Tuning = std::map<std::string, int>;

TEST(Determinism, TwentyRunsAreOnePicture) {
  const auto input = small_frame("curling");
  const Picture first = drawn_by_device(input, "tile");
  for (int run = 1; run < 20; ++run)
    EXPECT_TRUE(same_bits(first, drawn_by_device(input, "tile"))) << "run " << run;
}

struct TilesAndGroups : testing::TestWithParam<Tuning> {};

TEST_P(TilesAndGroups, OfAnySizeAreOnePicture) {
  for (const char* shading : {"curling", "wet"}) {
    const auto input = small_frame(shading);
    EXPECT_TRUE(same_bits(drawn_by_device(input, "tile"), drawn_with(input, {"tile", GetParam()})))
        << shading;
  }
}

INSTANTIATE_TEST_SUITE_P(Determinism, TilesAndGroups,
                         testing::Values(Tuning{{"TILE_W", 8}, {"TILE_H", 8}, {"GROUP", 5}}));
INSTANTIATE_TEST_SUITE_P(Full, TilesAndGroups,
                         testing::Values(Tuning{{"TILE_W", 16}}, Tuning{{"TILE_W", 24}, {"GROUP", 5}},
                                         Tuning{{"TILE_W", 8}, {"TILE_H", 8}}, Tuning{{"TILE_H", 16}},
                                         Tuning{{"GROUP", 1}}, Tuning{{"GROUP", 16}}));

// The pipeline does not draw a triangle in layers where Algorithm 2 of S would discard all its fragments. The
// omission of these triangles must not change any bit of the picture. The test compares the usual picture
// with a picture for which every triangle is drawn in all layers (REACH = 0).
TEST(Determinism, WhatClumpsHideIsLeftOutWithoutATrace) {
  for (const auto& frame : {small_frame("wet"), model_frame("bunny", 16, "curling", 160)})
    for (const char* cells : clump_cells)
      for (const char* scale : clump_scales) {
        const auto input = std::make_shared<FrameInput>(*frame);
        input->scene.clump.cells = cells;
        input->scene.clump.scale = scale;
        input->scene.clump.gain = 256;
        Shells shells(device(), input, {"tile", {}}), every_layer(device(), input, {"tile", {{"REACH", 0}}});
        shells.frame();
        every_layer.frame();
        EXPECT_TRUE(same_bits(shells.read(), every_layer.read())) << cells << ", " << scale;
        EXPECT_EQ(shells.count(), every_layer.count()) << cells << ", " << scale;
      }
}

// With clump.cells "consistent", what clumps hide depends on the size of a pixel on the fur. The sizes are
// from 1/8 to several texels: below, between and above the sizes for which the kernel computes the reach.
TEST(Determinism, WhatClumpsHideDependsOnTheView) {
  auto input = std::make_shared<FrameInput>(*model_frame("bunny", 16, "curling"));
  input->scene.clump.cells = "consistent";
  input->scene.wetness.blend = "overlap";
  for (const char* scale : clump_scales)
    for (const double distance : {1.3, 3.0, 12.0, 40.0}) {
      input->scene.clump.scale = scale;
      input->scene.clump.gain = 256;
      CameraScene camera = input->scene.camera;
      camera.eye = float(distance) * glm::normalize(camera.direction);
      input->camera = synthetic::camera(camera, 320, 240);
      Shells shells(device(), input, {"tile", {}}), every_layer(device(), input, {"tile", {{"REACH", 0}}});
      shells.frame();
      every_layer.frame();
      EXPECT_TRUE(same_bits(shells.read(), every_layer.read())) << scale << ", " << distance;
    }
}

// A renderer draws a single picture without the search for the layers in which wet fur can be visible.
TEST(Determinism, TheFirstPictureEqualsTheNext) {
  auto input = std::make_shared<FrameInput>(*model_frame("bunny", 16, "curling"));
  input->scene.clump.cells = "consistent";
  ShellOptions single{"tile", {}};
  single.refine = false;
  Shells first(device(), input, single), usual(device(), input, {"tile", {}});
  const auto kernels = [](const cl::FrameTiming& timing) {
    std::set<std::string> names;
    for (const cl::KernelTime& k : timing.kernels) names.insert(k.kernel);
    return names;
  };
  const cl::FrameTiming before = first.frame();
  usual.frame();
  EXPECT_TRUE(same_bits(first.read(), usual.read()));
  first.refine();
  const cl::FrameTiming after = first.still();
  usual.still();
  EXPECT_TRUE(same_bits(first.read(), usual.read()));
  if (before.kernels.empty()) GTEST_SKIP() << "this device has no event times";
  EXPECT_FALSE(kernels(before).contains("reach_in_view"));
  EXPECT_TRUE(kernels(after).contains("reach_in_view"));
}

TEST(Determinism, AnotherSceneIsAnotherPicture) {
  EXPECT_FALSE(same_bits(drawn_by_device(small_frame("curling"), "tile"),
                         drawn_by_device(small_frame("wet"), "tile")));
}

TEST(Determinism, MappingsAgree) {
  const auto input = small_frame("curling");
  const Picture tile = drawn_by_device(input, "tile"), pixel = drawn_by_device(input, "pixel");
  EXPECT_TRUE(same(tile, pixel));
  // Alpha is 0 in pixels without base surface and fur. The mappings `tile` and `pixel` must set alpha to 0 in
  // the same pixels.
  std::size_t differing = 0;
  for (std::size_t i = 0; i < tile.pixel.size(); ++i)
    differing += (tile.pixel[i].a == 0) != (pixel.pixel[i].a == 0);
  EXPECT_EQ(differing, 0u);
}

// Tests that the comparison of the device's pictures with the reference detects mistakes. Each test plants
// deliberate mistakes (mutants) in the reference. The comparison must then fail for both scenes of the test,
// and pass without a mistake.

using reference::Mutant;

/// Mistakes in the light of wet fur, in addition.
constexpr Mutant planted_wet[] = {Mutant::tangent_reversed, Mutant::eye_reversed, Mutant::facing_swapped};

/// Returns the frame with other values of the readings.
std::shared_ptr<const FrameInput> with_other_readings(FrameInput input) {
  input.scene.blend.faces = "all";
  input.scene.clump.scale = "literal";
  input.scene.clump.cells = "separate";
  input.scene.shading.tangent = "paper";
  input.scene.wetness.blend = "near";
  return std::make_shared<FrameInput>(std::move(input));
}

/// `drawn` is the device's picture of the scene. `input` may have wrong values.
void expect_seen(const FrameInput& input, Mutant mutant, const Picture& drawn, std::size_t least_pixels) {
  const Agreement agreement = compare(drawn_by_reference(input, mutant), drawn);
  EXPECT_GT(agreement.pixels, least_pixels);
  EXPECT_FALSE(within(agreement)) << "mutant " << int(mutant) << ": " << describe(agreement);
}

TEST(Mutants, AreSeen) {
  EXPECT_TRUE(drawn_alike(small_frame("curling"), "tile"));
  for (const auto& [frame, least_pixels] :
       {std::pair(small_frame("curling"), 5000u), std::pair(model_frame("torus", 16, "curling"), 20000u)}) {
    const auto input = with_other_readings(*frame);
    const Picture drawn = drawn_by_device(input, "tile");
    for (const Mutant mutant : planted) expect_seen(*input, mutant, drawn, least_pixels);
  }
}

// The same under the wet model, with the default readings, and a reference that ignores one of the constants
// sigma of W Eq. 3 and 5.
TEST(WetMutants, AreSeen) {
  for (const bool small : {true, false}) {
    const auto input = small ? small_frame("wet") : model_frame("torus", 16, "wet");
    const std::size_t least_pixels = small ? 5000 : 20000;
    const Picture drawn = drawn_by_device(input, "tile");
    EXPECT_TRUE(same(drawn_by_reference(*input), drawn));
    for (const Mutant mutant : planted_wet) expect_seen(*input, mutant, drawn, least_pixels);
    for (const Mutant mutant : planted)
      // With blend.faces "back-then-front", no two fragments of one layer of the torus that face the same way
      // lie on one pixel, so the order of the triangles has no effect there.
      if (small || mutant != Mutant::triangles_reversed) expect_seen(*input, mutant, drawn, least_pixels);
    for (float ShadingScene::*sigma :
         {&ShadingScene::occlusion, &ShadingScene::darkening, &ShadingScene::wet_specular}) {
      FrameInput mistaken = *input;
      EXPECT_GT(mistaken.scene.shading.*sigma, 0.1f);
      mistaken.scene.shading.*sigma = 0;
      expect_seen(mistaken, Mutant::none, drawn, 5000);
    }
  }
}

}  // namespace
}  // namespace pelage
