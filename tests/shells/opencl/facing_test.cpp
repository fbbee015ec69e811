// Tests blend.faces: fur of the far side must not cover fur of the near side (docs/frame.md, section 5).
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace pictures;

/// A torus with upright fur. Droplets cover the side that faces the eye. If `both`, droplets also cover the
/// far side.
std::shared_ptr<const FrameInput> torus_wet_in_front(const char* faces, bool both) {
  Scene scene = synthetic::lively_scene();
  scene.blend.faces = faces;
  scene.shading.model = "wet";
  scene.curl.radius = 0;
  scene.fur.length = .15f;
  scene.fur.layers = 12;
  scene.wetness.size = 256;
  scene.wetness.seams = "cut";
  // With "consistent", fur at the silhouette depends on clumps within a pixel's footprint, which is large
  // there.
  scene.clump.cells = "separate";
  scene.image.width = 160;
  scene.image.height = 120;
  FrameInput input = synthetic::frame(scene, synthetic::torus(), 60, 36, 600);
  const glm::vec3 eye(input.camera.eye);
  std::erase_if(input.droplets, [&](const Droplet& drop) {
    // The outward direction at a point of the torus whose circle has the radius 0.7 in the plane y = 0.
    const glm::vec3 ring = .7f * glm::normalize(glm::vec3(drop.point.x, 0, drop.point.z));
    const float towards = glm::dot(glm::normalize(drop.point - ring), glm::normalize(eye - drop.point));
    // No disc of a droplet on the far side reaches the near side.
    return !(towards > 0 || (both && towards < -0.6f));
  });
  return std::make_shared<FrameInput>(std::move(input));
}

struct Change {
  double rim = 0,
         inside = 0;  ///< mean change of a channel where the base does not cover the pixel, and where it does
};

/// Returns how the picture changes if the side that the eye does not see gets wet.
Change change_by_the_far_side(const char* faces, const char* mapping) {
  const auto near = torus_wet_in_front(faces, false), both = torus_wet_in_front(faces, true);
  EXPECT_LT(near->droplets.size() + 20, both->droplets.size());
  const Picture first = drawn_by_device(near, mapping), second = drawn_by_device(both, mapping);
  FrameInput base = *near;
  base.scene.fur.length = 1e-3f;
  const Picture shape = drawn_by_device(std::make_shared<FrameInput>(base), mapping);
  Change change;
  std::size_t rim = 0, inside = 0;
  for (std::size_t i = 0; i < first.pixel.size(); ++i) {
    if (!(first.pixel[i].w > 0.1f)) continue;
    const glm::vec3 d = glm::abs(glm::vec3(first.pixel[i]) - glm::vec3(second.pixel[i]));
    const double mean = double(d.x + d.y + d.z) / 3;
    const bool covered = shape.pixel[i].w == 1;
    (covered ? inside : rim) += 1;
    (covered ? change.inside : change.rim) += mean;
  }
  EXPECT_GT(rim, 500u);
  EXPECT_GT(inside, 2000u);
  return {change.rim / double(rim), change.inside / double(inside)};
}

struct FacesOf : testing::TestWithParam<const char*> {};

TEST_P(FacesOf, TheFarSideDoesNotCoverTheNearSide) {
  const Change all = change_by_the_far_side("all", GetParam());
  const Change front = change_by_the_far_side("front", GetParam());
  const Change both = change_by_the_far_side("back-then-front", GetParam());
  RecordProperty("rim_all", std::to_string(all.rim));
  RecordProperty("rim_back_then_front", std::to_string(both.rim));
  EXPECT_EQ(front.rim, 0);
  EXPECT_EQ(front.inside, 0);
  EXPECT_GT(all.rim, 0.01);
  EXPECT_LT(both.rim, all.rim);  // the far side still shows beyond the near strands
  EXPECT_LT(both.inside, all.inside + 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Device, FacesOf, testing::Values("tile", "pixel", "group"),
                         [](const auto& given) { return std::string(given.param); });

}  // namespace
}  // namespace pelage
