// Compares the kernels' strands and wetness mask with closed forms and with the reference. The inputs are
// synthetic. Lengths are in R.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/compare/tolerances.hpp"
#include "harness/shells/reference/mask.hpp"
#include "harness/shells/reference/strands.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using pictures::shells_of;
using synthetic::noise;

/// Returns a scene with upright strands of length .1 R, one substep per frame, and a picture of 16 x 16
/// pixels. There is no drag, gravity or wind.
Scene bare_scene() {
  Scene scene = synthetic::upright_scene();
  scene.fur.length = .1f;
  scene.fur.layers = 2;
  scene.dynamics.drag = 0;
  scene.dynamics.substeps = 1;
  scene.image.width = 16;
  scene.image.height = 16;
  return scene;
}

FrameInput bare(const Scene& scene) {
  return synthetic::frame(scene, synthetic::torus(), 9, 7, 0);
}

std::vector<glm::dvec3> tips_after(const FrameInput& input, int frames) {
  Shells device = shells_of(input);
  device.advance(frames);
  EXPECT_EQ(device.frames_simulated(), frames);
  const std::vector<glm::vec3> tips = device.tips();
  EXPECT_EQ(tips.size(), input.strands.anchor.size());
  return {tips.begin(), tips.end()};
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

TEST(KernelStrands, Equation3HoldsUnderRandomForces) {
  double highest = 0, lowest = 1;
  for (std::uint32_t trial = 0; trial < 12; ++trial) {
    const auto any = [&](std::uint32_t i) { return float(2 * noise(trial, i, 21) - 1); };
    Scene scene = bare_scene();
    scene.dynamics.drag = .002f;
    scene.dynamics.gravity = 150.f * glm::vec3(any(0), any(1), any(2));
    scene.dynamics.wind = {{any(3), any(4), any(5)}, any(6), 2, 5 * any(7), 1};
    const FrameInput input = bare(scene);
    Shells device = shells_of(input);
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

/// An input, and the greatest number of frames for which it is simulated.
struct Moving {
  FrameInput input;
  int frames;
};

/// The inputs for which tests of the reference have closed forms: a load under which some strands touch their
/// ball, swings from an inward preload, and small tangential swings. First, a scene with combed fur, drag,
/// gusts and gravity.
std::vector<Moving> moving_strands() {
  Scene lively = synthetic::lively_scene(), loaded = bare_scene();
  lively.fur.layers = 2;
  loaded.dynamics.drag = .02f;
  loaded.dynamics.gravity = {9, -14, 5};
  FrameInput inward = bare(bare_scene()), tilted = inward;
  const glm::dvec3 n(inward.strands.normal[0]);
  inward.strands.anchor[0] = glm::vec3(.09 * n);
  inward.scene.dynamics.gravity = glm::vec3(-8.0 * n);
  // The strand starts at its anchor, which is tilted by .3 rad. Upright, gravity and the spring's force
  // balance.
  const glm::dvec3 side = glm::normalize(glm::cross(n, glm::dvec3(.3, .5, .8)));
  tilted.strands.anchor[0] = .1 * (std::cos(.3) * n + std::sin(.3) * side);
  const DynamicsScene& d = tilted.scene.dynamics;
  tilted.scene.dynamics.gravity = d.stiffness / d.mass * (.1f * glm::vec3(n) - tilted.strands.anchor[0]);
  return {{synthetic::frame(lively, synthetic::torus(), 25, 17, 0), 120},
          {bare(loaded), 3000},
          {inward, 1200},
          {tilted, 240}};
}

TEST(KernelStrands, FollowTheReference) {
  for (const auto& [input, last] : moving_strands())
    for (const int frames : {1, 7, last}) {
      const std::vector<glm::dvec3> tips = tips_after(input, frames);
      const std::vector<reference::Strand> expected = reference::simulate(input, frames);
      double worst = 0, moved = 0;
      for (std::size_t f = 0; f < tips.size(); ++f) {
        worst = std::max(worst, glm::length(tips[f] - expected[f].tip));
        moved = std::max(moved, glm::length(tips[f] - glm::dvec3(input.strands.anchor[f])));
      }
      EXPECT_LT(worst, tolerance::small_scene) << frames << " of " << last;
      EXPECT_GT(moved, frames > 7 ? .01 : 1e-5) << frames << " of " << last;
    }
}

TEST(KernelStrands, FramesContinueWhereTheLastOneStopped) {
  const FrameInput input = *pictures::small_frame("curling");
  Shells device = shells_of(input);
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
      if (count % 40 == 1) input.scene.wetness.blend = "near", input.scene.clump.cells = "separate";
      Shells drawn = shells_of(input);
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

}  // namespace
}  // namespace pelage
