// Tests that clumps appear and dry without a jump if clump.cells is "consistent" and wetness.blend is
// "overlap" (docs/shells.md, sections 2 and 6).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace pictures;

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
