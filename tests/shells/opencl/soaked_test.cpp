// Tests soaked fur (docs/soaked.md).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <glm/common.hpp>

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

Picture drawn(FrameInput& input, float wetness) {
  for (Droplet& drop : input.droplets) drop.wetness = wetness;
  return drawn_by_device(std::make_shared<FrameInput>(input), "tile");
}

struct Steepest {
  Change greatest;  ///< of all steps
  int step = 0;     ///< the step with the greatest change of a pixel
};

/// Returns the greatest changes between the pictures of `steps` equal steps of the wetness from `low` to
/// `high`.
Steepest steepest(FrameInput& input, double low, double high, int steps) {
  Steepest found;
  Picture before = drawn(input, float(low));
  for (int i = 1; i <= steps; ++i) {
    const Picture now = drawn(input, float(low + (high - low) * i / steps));
    const Change c = change(before, now);
    if (c.most > found.greatest.most) found.step = i - 1;
    found.greatest.most = std::max(found.greatest.most, c.most);
    found.greatest.mean = std::max(found.greatest.mean, c.mean);
    before = now;
  }
  return found;
}

// The change is steep where the highlight of a clump appears or disappears: in the step with the greatest
// change, and in the part of this step with the greatest change, it becomes smaller with the step. Single
// pixels at the border of a disc still change by 0.05 at once (docs/soaked.md).
TEST(Soaked, ThePictureIsContinuousInTheWetness) {
  FrameInput input = wet_torus(0.5f);
  const Steepest coarse = steepest(input, 0.2, 1, 80);
  RecordProperty("greatest_change_per_0.01",
                 fmt::format("mean {:.4f} most {:.4f}", coarse.greatest.mean, coarse.greatest.most));
  EXPECT_GT(coarse.greatest.mean, 1e-4);
  EXPECT_LT(coarse.greatest.mean, 0.01);
  double low = 0.2 + 0.01 * coarse.step, width = 0.01;
  Steepest fine;
  for (int level = 0; level < 2; ++level) {
    fine = steepest(input, low, low + width, 20);
    width /= 20;
    low += width * fine.step;
    RecordProperty(fmt::format("greatest_change_level_{}", level),
                   fmt::format("mean {:.6f} most {:.4f}", fine.greatest.mean, fine.greatest.most));
  }
  EXPECT_LT(fine.greatest.mean, 0.02 * coarse.greatest.mean);
  EXPECT_LT(fine.greatest.most, 0.25 * coarse.greatest.most);
}

TEST(Soaked, BelowTheThresholdNothingChanges) {
  FrameInput soaked = wet_torus(0.6f), plain = wet_torus(1);
  for (FrameInput* input : {&soaked, &plain})
    input->droplets.resize(1);  // overlapping droplets would be wetter
  const Picture a = drawn(soaked, 0.6f), b = drawn(plain, 0.6f);
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

double brightest(const Picture& p) {
  double most = 0;
  for (const glm::vec4& pixel : p.pixel) most = std::max(most, double(pixel.y));
  return most;
}

// W, section 6: overly wet fur forms a smooth surface with a high specular reflection.
TEST(Soaked, SoakedFurIsSmoothAndBright) {
  FrameInput soaked = wet_torus(0.5f), plain = wet_torus(1);
  const Picture film = drawn(soaked, 1), clumps = drawn(plain, 1);
  RecordProperty("roughness", fmt::format("{:.4f} instead of {:.4f}", roughness(film), roughness(clumps)));
  EXPECT_LT(roughness(film), 0.6 * roughness(clumps));
  EXPECT_GT(brightest(film), 1.1 * brightest(clumps));
}

}  // namespace
}  // namespace pelage
