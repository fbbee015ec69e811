// Tests soaked fur (docs/shells.md, section 11).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <glm/common.hpp>
#include <numeric>
#include <vector>

#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace pictures;

/// A torus that is wet everywhere: droplets of equal wetness overlap.
FrameInput wet_torus(float threshold) {
  Scene scene = synthetic::lively_scene();
  scene.shading.model = "wet";
  scene.shading.tangent = "strand";
  scene.shading.exponent = 30;
  scene.clump.scale = "converge";
  scene.clump.cells = "consistent";
  scene.wetness.blend = "overlap";
  scene.soaked.threshold = threshold;
  scene.image.width = 240;
  scene.image.height = 180;
  return synthetic::frame(scene, synthetic::torus(), 60, 36, 400);
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
  const Picture a = drawn_soaked(soaked, 0.6f), b = drawn_soaked(plain, 0.6f);
  EXPECT_EQ(std::memcmp(a.pixel.data(), b.pixel.data(), a.pixel.size() * sizeof a.pixel[0]), 0);
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

}  // namespace
}  // namespace pelage
