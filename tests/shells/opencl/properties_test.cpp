// Compares the kernels' strands and wetness mask with closed forms and with the reference. The inputs are
// synthetic. Lengths are in R.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/compare/tolerances.hpp"
#include "harness/shells/reference/mask.hpp"
#include "harness/shells/reference/strands.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using synthetic::noise;

/// Returns a scene with upright strands of length .1 R, one substep per frame, and a picture of 16 x 16
/// pixels. There is no drag, gravity or wind.
Scene bare_scene() {
  Scene scene = synthetic::lively_scene();
  scene.fur.length = .1f;
  scene.fur.comb = 0;
  scene.fur.layers = 2;
  scene.dynamics = {};
  scene.dynamics.drag = 0;
  scene.dynamics.substeps = 1;
  scene.image.width = 16;
  scene.image.height = 16;
  return scene;
}

FrameInput bare(const Scene& scene) {
  return synthetic::frame(scene, synthetic::torus(), 9, 7, 0);
}

Shells shells(const FrameInput& input) {
  return Shells(pictures::device(), std::make_shared<FrameInput>(input));
}

std::vector<glm::dvec3> tips_after(const FrameInput& input, int frames) {
  Shells device = shells(input);
  device.advance(frames);
  EXPECT_EQ(device.frames_simulated(), frames);
  const std::vector<glm::vec3> tips = device.tips();
  EXPECT_EQ(tips.size(), input.strands.anchor.size());
  return {tips.begin(), tips.end()};
}

/// Returns the mean time between the moments at which the tip of strand 0 rises above `level` along
/// `direction`, relative to the natural period of its mass and spring. Simulates `frames` frames.
double relative_period(const FrameInput& input, const glm::dvec3& direction, double level, int frames) {
  Shells device = shells(input);
  const DynamicsScene& dynamics = input.scene.dynamics;
  std::vector<double> crossings;
  double before = glm::dot(glm::dvec3(input.strands.anchor[0]), direction);
  for (int frame = 1; frame <= frames; ++frame) {
    device.advance(1);
    const double now = glm::dot(glm::dvec3(device.tips()[0]), direction);
    if (before < level && now >= level)
      crossings.push_back((frame - 1 + (level - before) / (now - before)) * double(dynamics.step));
    before = now;
  }
  if (crossings.size() < 2) return 0;
  const double natural = 2 * std::numbers::pi * std::sqrt(double(dynamics.mass) / double(dynamics.stiffness));
  return (crossings.back() - crossings.front()) / double(crossings.size() - 1) / natural;
}

TEST(KernelStrands, RestStaysAtRest) {
  for (const float comb : {0.f, .6f}) {
    Scene scene = bare_scene();
    scene.fur.comb = comb;
    const FrameInput input = bare(scene);
    const std::vector<glm::dvec3> tips = tips_after(input, 500);
    for (std::size_t f = 0; f < tips.size(); ++f)
      ASSERT_LT(glm::length(tips[f] - glm::dvec3(input.strands.anchor[f])), 1e-7);
  }
}

TEST(KernelStrands, LoadMovesTheRestPositionAsTheBallAllows) {
  Scene scene = bare_scene();
  scene.dynamics.drag = .02f;
  scene.dynamics.gravity = {9, -14, 5};
  const FrameInput input = bare(scene);
  const std::vector<glm::dvec3> tips = tips_after(input, 3000);
  const double length = double(scene.fur.length), k = double(scene.dynamics.stiffness);
  const glm::dvec3 force = double(scene.dynamics.mass) * glm::dvec3(scene.dynamics.gravity);
  std::size_t inside = 0, outside = 0;
  for (std::size_t f = 0; f < tips.size(); ++f) {
    const glm::dvec3 n(input.strands.normal[f]), free = length * n + force / k;
    ASSERT_GT(glm::dot(free, n), 0);
    const bool held = glm::length(free) > length;
    (held ? outside : inside)++;
    ASSERT_LT(glm::length(tips[f] - (held ? length * glm::normalize(k * length * n + force) : free)),
              tolerance::small_scene);
  }
  EXPECT_GT(inside, 10u);
  EXPECT_GT(outside, 10u);
}

TEST(KernelStrands, SwingsFromAnInwardPreloadHaveTheSpringsPeriod) {
  // The anchor is the tip's position at rest without gravity. It is .09 R above the root, where R is the mesh
  // radius. Gravity pulls the tip towards the skin, so the tip swings between .09 R and .05 R above the root.
  // Eq. 3 of paper S keeps the tip inside a ball of radius .1 R, but the tip never reaches the surface of
  // this ball.
  FrameInput input = bare(bare_scene());
  const glm::dvec3 n(input.strands.normal[0]);
  input.strands.anchor[0] = glm::vec3(.09 * n);
  input.scene.dynamics.gravity = glm::vec3(-8.0 * n);
  EXPECT_NEAR(relative_period(input, n, .09 - .001 * 8 / .4, 1200), 1, .001);
}

TEST(KernelStrands, SmallTangentialSwingsHaveTheSpringsPeriod) {
  // The strand starts at its anchor, which is tilted by .3 rad from the normal. In the upright position p0,
  // the sum of gravity and the spring's force is 0, so the strand swings about p0.
  Scene scene = bare_scene();
  FrameInput input = bare(scene);
  const glm::dvec3 n(input.strands.normal[0]);
  const glm::dvec3 side = glm::normalize(glm::cross(n, glm::dvec3(.3, .5, .8)));
  const double length = double(scene.fur.length), k = double(scene.dynamics.stiffness);
  input.strands.anchor[0] = length * (std::cos(.3) * n + std::sin(.3) * side);
  const glm::dvec3 balance = k * (length * n - glm::dvec3(input.strands.anchor[0]));
  input.scene.dynamics.gravity = glm::vec3(balance / double(scene.dynamics.mass));
  EXPECT_NEAR(relative_period(input, side, 0, 240), 1, .01);
}

TEST(KernelStrands, Equation3HoldsUnderRandomForces) {
  double highest = 0, lowest = 1;
  for (std::uint32_t trial = 0; trial < 12; ++trial) {
    const auto any = [&](std::uint32_t i) { return float(2 * noise(trial, i, 21) - 1); };
    Scene scene = bare_scene();
    scene.dynamics.drag = .002f;
    scene.dynamics.gravity = 150.f * glm::vec3(any(0), any(1), any(2));
    scene.dynamics.wind = {{any(3), any(4), any(5)}, any(6), 2, 5 * any(7), 1};
    const FrameInput input = bare(scene);
    Shells device = shells(input);
    for (int frame = 0; frame < 60; ++frame) {
      device.advance(1);
      const std::vector<glm::vec3> tips = device.tips();
      for (std::size_t f = 0; f < tips.size(); ++f) {
        highest = std::max(highest, glm::length(glm::dvec3(tips[f])) / .1);
        lowest = std::min(lowest, glm::dot(glm::dvec3(tips[f]), glm::dvec3(input.strands.normal[f])) / .1);
      }
    }
  }
  EXPECT_LE(highest, 1 + 3e-7);  // the tolerance allows for a few float roundings
  EXPECT_GE(lowest, -3e-7);
  EXPECT_GT(highest, 1 - 3e-7);  // some tips must reach the fur's length, and some the skin
  EXPECT_LT(lowest, 3e-7);
}

TEST(KernelStrands, FollowTheReference) {
  Scene scene = synthetic::lively_scene();  // this scene has combed fur, drag, gusts and gravity
  scene.fur.layers = 2;
  const FrameInput input = synthetic::frame(scene, synthetic::torus(), 25, 17, 0);
  for (const int frames : {1, 7, 120}) {
    const std::vector<glm::dvec3> tips = tips_after(input, frames);
    const std::vector<reference::Strand> expected = reference::simulate(input, frames);
    double worst = 0, moved = 0;
    for (std::size_t f = 0; f < tips.size(); ++f) {
      worst = std::max(worst, glm::length(tips[f] - expected[f].tip));
      moved = std::max(moved, glm::length(tips[f] - glm::dvec3(input.strands.anchor[f])));
    }
    EXPECT_LT(worst, tolerance::small_scene) << frames;
    EXPECT_GT(moved, frames > 5 ? .01 : 1e-5);
  }
}

TEST(KernelStrands, FramesContinueWhereTheLastOneStopped) {
  const FrameInput input = *pictures::small_frame("curling");
  Shells device = shells(input);
  device.advance(3);
  device.frame();
  device.advance(2);
  EXPECT_EQ(device.frames_simulated(), 6);
  const std::vector<glm::vec3> tips = device.tips();
  const std::vector<glm::dvec3> at_once = tips_after(input, 6);
  for (std::size_t f = 0; f < tips.size(); ++f) ASSERT_EQ(glm::dvec3(tips[f]), at_once[f]);
}

/// Returns a frame with `count` random droplets and a mask of size x size texels.
FrameInput rained(int size, std::uint32_t count, std::uint32_t seed) {
  Scene scene = bare_scene();
  scene.wetness.size = size;
  FrameInput input = bare(scene);
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto any = [&](std::uint32_t k) { return noise(seed, i, k); };
    const glm::vec2 centre(any(0), any(1));
    const std::size_t texel = std::size_t(any(1) * size) * std::size_t(size) + std::size_t(any(0) * size);
    input.droplets.push_back({centre, float(.01 + .12 * any(2)), float(any(3)), input.mask_surface[texel],
                              any(4) < .3 ? .2f : 5.f});
  }
  return input;
}

TEST(KernelMask, IsAlgorithm1OverRandomDropletsInOrder) {
  for (const int size : {1, 37, 64, 256})
    for (const std::uint32_t count : {0u, 1u, 40u, 41u, 400u, 401u}) {
      FrameInput input = rained(size, count, std::uint32_t(size));
      if (count % 40 == 1) input.scene.wetness.blend = "overlap";
      Shells drawn = shells(input);
      EXPECT_EQ(drawn.mask_time().all > 0, count > 0) << "no droplets, no kernel";
      const std::vector<glm::vec4> mask = drawn.mask();
      const reference::Mask expected = reference::wetness_mask(input);
      ASSERT_EQ(mask.size(), expected.texel.size());
      std::size_t wrong = 0, wet = 0;
      for (std::size_t i = 0; i < mask.size(); ++i) {
        const reference::Clump& e = expected.texel[i];
        const glm::dvec4 texel(mask[i]);
        wet += e.wetness > 0;
        wrong += glm::length(texel - glm::dvec4(e.centre, e.radius, e.wetness)) > tolerance::small_scene;
      }
      // If the centre of a texel is very close to the border of a disc, float rounding decides whether the
      // disc covers the texel. At most 1 in 20,000 texels may differ.
      EXPECT_LE(wrong, mask.size() / 20000) << size << " texels, " << count << " droplets";
      if (count >= 400 && size > 1) {
        EXPECT_GT(wet, mask.size() / 2);
      }
      // The test can detect a wrong order of the droplets only if the mask depends on this order. The next
      // lines check that the reversed order gives a different mask.
      if (count == 400 && size == 64) {
        const reference::Mask reversed =
            reference::wetness_mask(input, 1, reference::Mutant::droplets_reversed);
        std::size_t different = 0;
        for (std::size_t i = 0; i < mask.size(); ++i)
          different += reversed.texel[i].centre != expected.texel[i].centre;
        EXPECT_GT(different, mask.size() / 4);
      }
    }
}

TEST(KernelMask, HandMadeDropletsBlendAndOverwrite) {
  FrameInput input = rained(8, 0, 0);
  input.scene.wetness.blend = "near";
  input.scene.clump.cells = "separate";
  const auto drop = [](float u, float radius, float wetness) {
    return Droplet{{u, .55f}, radius, wetness, {0, 0, 0}, 100};
  };
  const auto texel = [](const FrameInput& frame) { return shells(frame).mask()[4 * 8 + 4]; };
  const auto expect = [](const glm::vec4& got, const glm::vec4& want) {
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(got[c], want[c], 1e-6);
  };
  input.droplets = {drop(.5f, .3f, .4f), drop(.6f, .2f, .4f)};
  expect(texel(input), {.55, .55, .25, .8});  // paper S, Algorithm 1: alpha = .4 / .8
  input.droplets = {drop(.5f, .3f, .5f), drop(.6f, .2f, .8f)};
  expect(texel(input), {.58, .55, .22, 1});  // wetness clamped to 1, alpha = .8 / 1
  input.droplets = {drop(.3f, .35f, .4f), drop(.6f, .2f, .7f)};
  // The first droplet's centre is outside the second droplet's disc of radius .2. In this case Algorithm 1 of
  // paper S overwrites the texel with the second droplet.
  expect(texel(input), {.6, .55, .2, .7});
  input.droplets = {drop(.6f, .2f, .7f), drop(.3f, .35f, .4f)};
  // The small droplet now precedes the large droplet. The centre of the small droplet is inside the large
  // droplet's disc of radius .35. In this case Algorithm 1 of paper S blends the two droplets, and the weight
  // of the large droplet is alpha = .4.
  expect(texel(input), {.48, .55, .26, 1});
}

}  // namespace
}  // namespace pelage
