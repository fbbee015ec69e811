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

struct Change {
  double mean = 0, most = 0;  ///< of the channels' absolute differences
};

Change change(const Picture& a, const Picture& b) {
  Change c;
  for (std::size_t i = 0; i < a.pixel.size(); ++i) {
    const glm::vec3 d = glm::abs(glm::vec3(a.pixel[i]) - glm::vec3(b.pixel[i]));
    c.mean += double(d.x + d.y + d.z) / 3;
    c.most = std::max({c.most, double(d.x), double(d.y), double(d.z)});
  }
  c.mean /= double(a.pixel.size());
  return c;
}

// The largest change of a channel per 0.01 of wetness is that of a pixel where the highlight of a clump
// appears or disappears. It is a steep slope and not a jump: it becomes smaller with the step.
TEST(Soaked, ThePictureIsContinuousInTheWetness) {
  FrameInput input = wet_torus(0.5f);
  Change greatest;
  int at = 0;
  Picture before = drawn(input, 0.2f);
  for (int i = 21; i <= 100; ++i) {
    const Picture now = drawn(input, float(i) / 100);
    const Change c = change(before, now);
    greatest.mean = std::max(greatest.mean, c.mean);
    if (c.most > greatest.most) at = i;
    greatest.most = std::max(greatest.most, c.most);
    before = now;
  }
  RecordProperty("greatest_change_per_0.01",
                 fmt::format("mean {:.4f} most {:.4f} at {}", greatest.mean, greatest.most, at));
  EXPECT_GT(greatest.mean, 1e-4);
  EXPECT_LT(greatest.mean, 0.01);
  Change fine;
  before = drawn(input, float(at - 1) / 100);
  for (int k = 1; k <= 50; ++k) {
    const Picture now = drawn(input, (float(at - 1) + float(k) / 50) / 100);
    fine.most = std::max(fine.most, change(before, now).most);
    before = now;
  }
  RecordProperty("greatest_change_per_0.0002", fmt::format("most {:.4f}", fine.most));
  EXPECT_LT(fine.most, 0.15 * greatest.most);
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
