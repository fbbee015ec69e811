// Tests the wetness mask of frames whose water changes over time (docs/shells.md, section 10).
#include "harness/prepare/water.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

#include "harness/compare/checks.hpp"
#include "harness/compare/frame_output.hpp"
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
  Shells other = shells_of(input, {"", {{"REACH", 0}}});
  other.advance(frames - 1);
  other.frame();
  EXPECT_TRUE(same_bits(drawn.read(), other.read()));
}

// Tests soaked fur (docs/shells.md, section 11), and that clumps appear and dry without a jump if clump.cells
// is "consistent" and wetness.blend is "overlap" (docs/shells.md, sections 2 and 6).

/// A torus with `droplets` random droplets.
FrameInput torus_with(const char* scale, int droplets) {
  Scene scene = synthetic::lively_scene();
  scene.shading.model = "wet";
  scene.shading.tangent = "strand";
  scene.clump.scale = scale;
  scene.clump.cells = "consistent";
  scene.wetness.blend = "overlap";
  scene.image.width = 240;
  scene.image.height = 180;
  return synthetic::frame(scene, synthetic::torus(), 60, 36, droplets);
}

/// A torus that is wet everywhere: droplets of equal wetness overlap.
FrameInput wet_torus(float threshold) {
  FrameInput input = torus_with("converge", 400);
  input.scene.shading.exponent = 30;
  input.scene.soaked.threshold = threshold;
  return input;
}

Picture drawn_soaked(FrameInput& input, float wetness) {
  for (Droplet& drop : input.droplets) drop.wetness = wetness;
  return drawn_by_device(std::make_shared<FrameInput>(input), "tile");
}

/// Returns the greatest changes between the pictures of adjacent wetnesses from 0.2 to 1, in steps of 0.01.
Change greatest_change(FrameInput& input) {
  Change greatest;
  Picture before = drawn_soaked(input, 0.2f);
  for (int i = 21; i <= 100; ++i) {
    const Picture now = drawn_soaked(input, float(i) / 100);
    const Change c = change(before, now);
    greatest.most = std::max(greatest.most, c.most);
    greatest.mean = std::max(greatest.mean, c.mean);
    before = now;
  }
  return greatest;
}

TEST(Soaked, TheChangePerStepOfWetnessIsSmall) {
  FrameInput input = wet_torus(0.5f);
  const Change greatest = greatest_change(input);
  RecordProperty("greatest_change_per_0.01",
                 fmt::format("mean {:.4f} most {:.4f}", greatest.mean, greatest.most));
  EXPECT_GT(greatest.mean, 1e-4);
  EXPECT_LT(greatest.mean, 0.005);  // as docs/shells.md, section 11, says
  EXPECT_LT(greatest.most, 0.3);
  for (const double low : {0.2, 0.3, 0.5, 0.7, 0.92}) {
    const Picture first = drawn_soaked(input, float(low)),
                  last = drawn_soaked(input, float(low + 0.01 / 400));
    EXPECT_LT(change(first, last).mean, 0.02 * greatest.mean);
  }
}

float difference(const glm::vec4& a, const glm::vec4& b) {
  const glm::vec3 d = glm::abs(glm::vec3(a) - glm::vec3(b));
  return std::max({d.x, d.y, d.z});
}

/// Returns the `count` pixels that differ most.
std::vector<std::size_t> most_different(const Picture& a, const Picture& b, std::size_t count) {
  std::vector<std::size_t> pixels(a.pixel.size());
  std::iota(pixels.begin(), pixels.end(), std::size_t(0));
  std::ranges::partial_sort(pixels, pixels.begin() + std::ptrdiff_t(count), std::greater(),
                            [&](std::size_t i) { return difference(a.pixel[i], b.pixel[i]); });
  pixels.resize(count);
  return pixels;
}

/// Searches the interval of wetness from `low` to `high` for a jump of a pixel: halves the interval `levels`
/// times and keeps the half in which the pixel changes more. Returns the pixel's change in the last interval.
float change_in_the_limit(FrameInput& input, std::size_t pixel, double low, double high, int levels) {
  glm::vec4 first = drawn_soaked(input, float(low)).pixel[pixel],
            last = drawn_soaked(input, float(high)).pixel[pixel];
  for (int i = 0; i < levels; ++i) {
    const double middle = 0.5 * (low + high);
    const glm::vec4 between = drawn_soaked(input, float(middle)).pixel[pixel];
    const bool lower = difference(first, between) > difference(between, last);
    (lower ? high : low) = middle;
    (lower ? last : first) = between;
  }
  return difference(first, last);
}

// Without curls: where curls relax, an outline that moves passes the centres of pixels.
TEST(Soaked, EveryPixelIsContinuousInTheWetness) {
  FrameInput input = wet_torus(0.5f);
  input.scene.curl.radius = 0;
  float greatest = 0, jump = 0;
  for (const double low : {0.3, 0.52, 0.76, 0.92, 0.98}) {
    const double high = low + 0.01;
    const Picture first = drawn_soaked(input, float(low)), last = drawn_soaked(input, float(high));
    for (const std::size_t pixel : most_different(first, last, 3)) {
      greatest = std::max(greatest, difference(first.pixel[pixel], last.pixel[pixel]));
      jump = std::max(jump, change_in_the_limit(input, pixel, low, high, 10));
    }
  }
  RecordProperty("greatest_change_per_0.01", fmt::format("{:.4f}", greatest));
  RecordProperty("greatest_change_per_0.00001", fmt::format("{:.5f}", jump));
  EXPECT_GT(greatest, 0.05f);
  EXPECT_LT(jump, 0.002f);
}

TEST(Soaked, BelowTheThresholdNothingChanges) {
  FrameInput soaked = wet_torus(0.6f), plain = wet_torus(1);
  for (FrameInput* input : {&soaked, &plain})
    input->droplets.resize(1);  // overlapping droplets would be wetter
  EXPECT_TRUE(same_bits(drawn_soaked(soaked, 0.6f), drawn_soaked(plain, 0.6f)));
}

/// Returns the mean absolute difference of horizontally adjacent pixels inside the fur.
double roughness(const Picture& p) {
  double sum = 0, count = 0;
  for (std::size_t i = 1; i < p.pixel.size(); ++i) {
    if (p.pixel[i].w < 0.999f || p.pixel[i - 1].w < 0.999f) continue;
    sum += double(std::abs(p.pixel[i].y - p.pixel[i - 1].y));
    ++count;
  }
  return sum / count;
}

/// Returns the mean green of the brightest 1% of the pixels.
double highlight(const Picture& p) {
  std::vector<float> green;
  for (const glm::vec4& pixel : p.pixel) green.push_back(pixel.y);
  const auto bright = std::ptrdiff_t(green.size() / 100);
  std::ranges::partial_sort(green, green.begin() + bright, std::greater());
  return std::accumulate(green.begin(), green.begin() + bright, 0.0) / double(bright);
}

// W, section 6: overly wet fur forms a smooth surface with a high specular reflection.
TEST(Soaked, SoakedFurIsSmoothAndBright) {
  FrameInput soaked = wet_torus(0.5f), plain = wet_torus(1);
  const Picture film = drawn_soaked(soaked, 1), clumps = drawn_soaked(plain, 1);
  RecordProperty("roughness", fmt::format("{:.4f} instead of {:.4f}", roughness(film), roughness(clumps)));
  EXPECT_LT(roughness(film), 0.6 * roughness(clumps));
  RecordProperty("highlight", fmt::format("{:.4f} instead of {:.4f}", highlight(film), highlight(clumps)));
  EXPECT_GT(highlight(film), 1.1 * highlight(clumps));
}

Picture drawn(const FrameInput& input) {
  return drawn_by_device(std::make_shared<FrameInput>(input), "tile");
}

TEST(Drying, FurThatIsAlmostDryIsDryBitForBit) {
  for (const char* scale : clump_scales) {
    FrameInput input = torus_with(scale, 60);
    for (Droplet& drop : input.droplets) drop.wetness = 0x1p-40f;
    const Picture almost = drawn(input);
    input.droplets.clear();
    const Picture dry = drawn(input);
    EXPECT_TRUE(same_bits(almost, dry)) << scale;
  }
}

// One more droplet, in the middle of the picture, of a wetness that falls by factors of 10. Its change must
// fall at least as fast as its wetness.
TEST(Drying, AFaintDropletChangesLittleOverDryAndOverWetFur) {
  for (const char* scale : {"converge", "distance"})
    for (const int droplets : {0, 60}) {
      SCOPED_TRACE(fmt::format("{} over {} droplets", scale, droplets));
      FrameInput input = torus_with(scale, droplets);
      const Picture before = drawn(input);
      FrameInput source = torus_with(scale, 400);
      const glm::vec3 eye(input.camera.eye);
      // The droplet that is nearest to the eye is in the middle of what is seen.
      const auto nearest = std::min_element(
          source.droplets.begin(), source.droplets.end(), [&](const Droplet& a, const Droplet& b) {
            return glm::distance(a.point, eye) < glm::distance(b.point, eye);
          });
      input.droplets.push_back(*nearest);
      std::vector<Change> found;
      for (int power = 1; power <= 6; ++power) {
        input.droplets.back().wetness = float(std::pow(10., -power));
        found.push_back(change(drawn(input), before));
      }
      for (std::size_t i = 0; i < found.size(); ++i)
        RecordProperty(fmt::format("{}_{}_1e-{}", scale, droplets, i + 1),
                       fmt::format("mean {:.3g} most {:.3g}", found[i].mean, found[i].most));
      EXPECT_GT(found[0].mean, 1e-6);
      // A droplet of wetness 0.1 moves strands by several pixels. Its change is less than 10 times that of
      // the next one. The last changes approach the rounding of single precision.
      EXPECT_LE(found[1].mean, 0.2 * found[0].mean);
      for (std::size_t i = 2; i < found.size(); ++i)
        EXPECT_LE(found[i].mean, 0.11 * found[i - 1].mean + 1e-7) << "wetness 1e-" << i + 1;
      EXPECT_LE(found[2].most, 8 / 255.);
    }
}

}  // namespace
}  // namespace pelage
