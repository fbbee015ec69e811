// A mapping is a way to assign pixels to work-items. This file tests that the mapping `group` covers the same
// pixels as the mapping `tile`, and that it draws the same picture in every run. picture_test.cpp compares
// the pictures of `group` with the reference. properties_coverage_test.cpp compares the coverage of `group`
// with exact integer computations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/error.hpp"
#include "tests/shells/opencl/coverage_scene.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace pictures;

std::shared_ptr<const FrameInput> tiny_frame() {
  Scene scene = synthetic::lively_scene();
  scene.shading.model = "wet";
  scene.image.width = 61;
  scene.image.height = 45;
  return std::make_shared<FrameInput>(synthetic::frame(scene, synthetic::torus(), 30, 20, 40));
}

TEST(Group, CountsTheFragmentsThatTheOthersCount) {
  const auto input = tiny_frame();
  const auto counted = [&](const char* mapping) {
    Shells shells(device(), input, {mapping, {}});
    shells.frame();
    return shells.count();
  };
  const std::uint64_t tile = counted("tile");
  EXPECT_GT(tile, 10000u);
  EXPECT_EQ(counted("group"), tile);
  EXPECT_EQ(counted("pixel"), tile);
}

TEST(Group, CoversThePixelsThatTilesCover) {
  // The test draws a fan of thin triangles around one point. Some corners are beyond the guard band. The
  // second value of row_w makes the clip coordinate w depend on y, so some triangles also cross the near
  // plane.
  for (const glm::vec4 row_w : {glm::vec4(0, 0, -.5f, 1), glm::vec4(0, .001f, -.5f, 1)}) {
    Flat flat{{{3, -7}}, {}, 131, 77, row_w};
    constexpr std::uint32_t spokes = 40;
    for (std::uint32_t i = 0; i < spokes; ++i) {
      const float angle = 6.2831853f * float(i) / spokes, radius = i % 2 ? 60.f : 90000.f;
      flat.vertex.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
      flat.triangle.emplace_back(0, 1 + i, 1 + (i + 1) % spokes);
    }
    const std::vector<int> tile = covered_counts(flat, {"tile", {}});
    EXPECT_GT(std::count(tile.begin(), tile.end(), 1), 3000);
    EXPECT_TRUE(covered_counts(flat, {"group", {}}) == tile);
  }
}

TEST(Group, TwentyRunsAreOnePicture) {
  const auto input = tiny_frame();
  const auto drawn = [&](const std::map<std::string, int>& tuning) {
    Shells shells(device(), input, {"group", tuning});
    shells.frame();
    return shells.read();
  };
  const Picture first = drawn({});
  EXPECT_GT(std::count_if(first.pixel.begin(), first.pixel.end(), [](const glm::vec4& p) { return p.w > 0; }),
            500);
  for (int run = 1; run < 20; ++run) EXPECT_TRUE(same_bits(first, drawn({}))) << "run " << run;
  // The mapping `group` processes the layers in batches. The number of layers per batch (GROUP) must not
  // change the picture.
  for (const int group : {1, 3, 16}) EXPECT_TRUE(same_bits(first, drawn({{"GROUP", group}}))) << group;
}

TEST(Group, DrawsNothingWhereNothingIs) {
  // The camera looks past the mesh, so every triangle list is empty, and every pixel must have the
  // background colour.
  FrameInput input = *tiny_frame();
  input.scene.image.background = {.1f, .2f, .3f};
  input.scene.camera.target = {40, 1, 40};
  input.camera = synthetic::camera(input.scene.camera, 61, 45);
  Shells shells(device(), std::make_shared<FrameInput>(input), {"group", {}});
  shells.frame();
  const Picture picture = shells.read();
  ASSERT_EQ(picture.pixel.size(), 61u * 45u);
  EXPECT_TRUE(std::all_of(picture.pixel.begin(), picture.pixel.end(),
                          [](const glm::vec4& pixel) { return pixel == glm::vec4(.1f, .2f, .3f, 0); }));
}

TEST(Group, IsWhatDevicesOfOneLaneDrawWith) {
  cl::DeviceInfo gpu, cpu;
  gpu.gpu = true;
  cpu.cpu = true;
  cpu.lanes = 16;
  EXPECT_EQ(default_mapping(gpu), "group");
  EXPECT_EQ(default_mapping(cpu), "tile");
  EXPECT_EQ(mappings_on(cpu), (std::vector<std::string>{"tile", "pixel", "group"}));
  EXPECT_EQ(mappings_on(gpu), (std::vector<std::string>{"group", "pixel"}));
  cpu.lanes = 1;
  EXPECT_EQ(mappings_on(cpu), mappings_on(gpu));
  EXPECT_EQ(offered_mapping("", gpu), "group");
  EXPECT_EQ(offered_mapping("pixel", gpu), "pixel");
  EXPECT_THROW(offered_mapping("tile", gpu), InputError);
}

}  // namespace
}  // namespace pelage
