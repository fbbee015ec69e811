// Tests the wetness mask of frames whose water changes over time (docs/shells.md, section 10).
#include "harness/prepare/water.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "harness/compare/checks.hpp"
#include "harness/shells/reference/mask.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace pictures;

/// A torus on which 60 droplets arrive within 0.2 s, soak in within 0.1 s, and dry within about 0.5 s.
FrameInput rainy(const char* cells = "consistent") {
  Scene scene = synthetic::lively_scene();
  scene.shading.model = "wet";
  scene.shading.tangent = "strand";
  scene.clump.scale = "converge";
  scene.clump.cells = cells;
  scene.wetness.blend = "overlap";
  scene.wetness.soak = .1f;
  scene.wetness.drying = .5f;
  scene.wetness.drip = 1.5f;
  scene.image.width = 160;
  scene.image.height = 120;
  FrameInput input = synthetic::frame(scene, synthetic::torus(), 40, 24, 60);
  scene.wetness.rate = 300;
  set_arrivals(scene.wetness, input.droplets, 0);
  return input;
}

Shells shells_of(const FrameInput& input) {
  return Shells(device(), std::make_shared<FrameInput>(input));
}

std::vector<glm::vec4> reference_mask(const FrameInput& input, int frames) {
  std::vector<glm::vec4> mask;
  for (const reference::Clump& t : reference::wetness_mask(input, frames).texel)
    mask.emplace_back(glm::vec2(t.centre), t.radius, t.wetness);
  return mask;
}

bool same_texels(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(glm::vec4)) == 0;
}

std::size_t wet_texels(const std::vector<glm::vec4>& mask) {
  return std::size_t(std::count_if(mask.begin(), mask.end(), [](const glm::vec4& t) { return t.w > 0; }));
}

TEST(WetFrames, HaveTheMaskOfTheirTime) {
  for (const char* cells : {"consistent", "separate"}) {
    const FrameInput input = rainy(cells);
    Shells drawn = shells_of(input);
    std::vector<std::size_t> wet;
    for (int frame = 1; frame <= 60; ++frame) {
      drawn.frame();
      if (frame % 6 != 1) continue;
      const std::vector<glm::vec4> mask = drawn.mask();
      wet.push_back(wet_texels(mask));
      for (const Check& check : check_mask(mask, reference_mask(input, frame)))
        // A texel's centre may be so close to the border of a disc that rounding decides.
        EXPECT_LE(check.value, check.metric.starts_with("texels") ? 2 : check.limit)
            << cells << ", frame " << frame << ": " << check.metric;
    }
    EXPECT_EQ(wet.front(), 0u);
    EXPECT_GT(wet[2], 1000u);
    EXPECT_EQ(wet.back(), 0u);
  }
}

// With more than TexelLists::most droplets over a texel, frames use the lists of buckets.
TEST(WetFrames, HaveTheMaskOfTheirTimeUnderManyDroplets) {
  for (const char* cells : {"consistent", "separate"}) {
    FrameInput input = rainy(cells);
    const std::vector<Droplet> few = input.droplets;
    for (int copies = 0; copies < 6; ++copies)
      for (Droplet droplet : few) {
        droplet.radius *= 2.5f + 0.3f * float(copies);
        droplet.wetness *= 0.1f;
        input.droplets.push_back(droplet);
      }
    Shells drawn = shells_of(input);
    drawn.advance(11);
    const cl::FrameTiming timing = drawn.frame();
    if (!timing.kernels.empty()) {
      EXPECT_EQ(timing.kernels.front().kernel, "wetness_mask");
    }
    const std::vector<glm::vec4> expected = reference_mask(input, 12);
    for (const Check& check : check_mask(drawn.mask(), expected))
      EXPECT_LE(check.value, check.metric.starts_with("texels") ? 2 : check.limit)
          << cells << ": " << check.metric;
    EXPECT_GT(wet_texels(expected), 1000u);
  }
}

TEST(WetFrames, DoNotDependOnTheFramesBefore) {
  FrameInput input = rainy();
  Shells all = shells_of(input), last = shells_of(input);
  for (int frame = 0; frame < 14; ++frame) all.frame();
  last.advance(13);
  last.frame();
  EXPECT_GT(wet_texels(all.mask()), 1000u);
  EXPECT_TRUE(same_texels(all.mask(), last.mask()));
  EXPECT_TRUE(same_bits(all.read(), last.read()));
  // The constructor computes the mask of the picture at dynamics.time.
  input.scene.dynamics.time = float(picture_time(input.scene.dynamics, 14));
  EXPECT_TRUE(same_texels(shells_of(input).mask(), all.mask()));
}

TEST(WetFrames, AgreeWithTheReference) {
  const FrameInput input = rainy();
  Shells drawn = shells_of(input);
  drawn.advance(frames - 1);
  drawn.frame();
  const Picture picture = drawn.read(), expected = drawn_by_reference(input);
  const Agreement agreement = compare(picture, expected);
  EXPECT_TRUE(within(agreement)) << describe(agreement);
  FrameInput soaked = input;
  soaked.scene.wetness = rainy().scene.wetness;
  soaked.scene.wetness.soak = soaked.scene.wetness.drying = soaked.scene.wetness.drip = 0;
  for (Droplet& droplet : soaked.droplets) droplet.arrival = 0;
  EXPECT_FALSE(within(compare(picture, drawn_by_reference(soaked)))) << "the water has no effect";
}

TEST(WetFrames, EndAsTheyBegan) {
  const FrameInput input = rainy();
  FrameInput dry = input;
  dry.droplets.clear();
  Shells rain = shells_of(input), none = shells_of(dry);
  for (const int frames : {1, 60}) {
    rain.advance(frames - rain.frames_simulated() - 1);
    none.advance(frames - none.frames_simulated() - 1);
    rain.frame();
    none.frame();
    EXPECT_TRUE(same_bits(rain.read(), none.read())) << "frame " << frames;
  }
}

TEST(WetFrames, HaveThePhaseWetOnlyIfTheWaterChanges) {
  FrameInput input = rainy();
  input.scene.fur.substeps = 2;
  const cl::FrameTiming timing = shells_of(input).frame();
  if (timing.phase_event_ms.empty()) GTEST_SKIP() << "this device has no event times";
  EXPECT_TRUE(timing.phase_event_ms.contains("wet"));
  std::vector<std::string> kernels;
  for (const cl::KernelTime& k : timing.kernels)
    if (k.phase == "wet") kernels.push_back(k.kernel);
  EXPECT_EQ(kernels, (std::vector<std::string>{"wetness_mask_by_texel", "vertex_dryness", "vertex_curls",
                                               "texel_clumps", "texel_reach", "triangle_reach_by_texel"}));
  input.scene.wetness.soak = input.scene.wetness.drying = input.scene.wetness.drip = 0;
  for (Droplet& droplet : input.droplets) droplet.arrival = 0;
  EXPECT_FALSE(shells_of(input).frame().phase_event_ms.contains("wet"));
}

// Triangles that are dry in one frame may be wet in another. With REACH = 0 no triangle is treated as dry.
TEST(WetFrames, HaveTheLayersOfTheirTriangles) {
  const FrameInput input = rainy("separate");
  Shells drawn = shells_of(input);
  drawn.frame();
  drawn.advance(frames - 2);
  drawn.frame();
  ShellOptions all_layers;
  all_layers.tuning = {{"REACH", 0}};
  Shells other(device(), std::make_shared<FrameInput>(input), all_layers);
  other.advance(frames - 1);
  other.frame();
  EXPECT_TRUE(same_bits(drawn.read(), other.read()));
}

}  // namespace
}  // namespace pelage
