// Tests the ray-casting of strands on scenes whose pictures follow from geometry, and against the
// double-precision reference of pictures of strands.
#include "harness/strands/raycast/raycast.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/strands/reference/drawing.hpp"
#include "tests/strands/support/ball.hpp"

namespace pelage::strands {
namespace {

RaycastScene scene_at(int width, int height, glm::vec3 eye, const Paint& paint = {glm::vec3(1), 1}) {
  RaycastScene scene;
  scene.camera = camera_at(width, height, eye);
  scene.strand_paint = [paint](std::uint32_t, float) { return paint; };
  return scene;
}

// A cylinder of radius r at the distance d appears as wide as a disc of radius r d / sqrt(d^2 - r^2) in the
// plane through its axis.
TEST(Raycast, AStraightStrandCoversItsProjection) {
  const float distance = 4, width = 0.2f;
  RaycastScene scene = scene_at(200, 100, {0, 0, distance});
  const RaycastResult found =
      raycast(scene, {straight({0, -3, 0}, {0, 3, 0}, width)}, {.cones = 8, .samples = 8});
  const double radius = 0.5 * double(width), d = double(distance);
  const double pixels =
      2 * radius * d / std::sqrt(d * d - radius * radius) / (d * double(scene.camera.pixel));
  EXPECT_NEAR(covered(found.picture) / 100, pixels, 0.01 * pixels);
}

// The taper halves the mean width.
TEST(Raycast, TheTaperNarrowsAStrand) {
  RaycastScene scene = scene_at(200, 100, {0, 0, 4});
  const std::vector<DrawnStrand> strand{straight({0, -0.5f, 0}, {0, 0.5f, 0}, 0.1f)};
  const double whole = covered(raycast(scene, strand, {.samples = 8}).picture);
  scene.radius = [](std::uint32_t, float t) { return 0.05f * (1 - t); };
  EXPECT_NEAR(covered(raycast(scene, strand, {.samples = 8}).picture), 0.5 * whole, 0.03 * whole);
}

TEST(Raycast, StrandsBlendFromFrontToBack) {
  RaycastScene scene = scene_at(9, 9, {0, 0, 4});
  scene.background = {0, 0, 1};
  scene.strand_paint = [](std::uint32_t strand, float) {
    return strand == 0 ? Paint{{1, 0, 0}, 0.5f} : Paint{{0, 1, 0}, 0.25f};
  };
  // Strand 1 is in front.
  const RaycastResult found =
      raycast(scene, {straight({0, -1, 0}, {0, 1, 0}, 1), straight({0, -1, 1.5f}, {0, 1, 1.5f}, 0.8f)},
              {.cones = 4, .samples = 1});
  const glm::vec4 centre = found.picture.pixel[4 * 9 + 4];
  EXPECT_NEAR(centre.x, 0.75 * 0.5, 1e-6);
  EXPECT_NEAR(centre.y, 0.25, 1e-6);
  EXPECT_NEAR(centre.z, 0.75 * 0.5, 1e-6);
  EXPECT_NEAR(centre.w, 1 - 0.75 * 0.5, 1e-6);
}

TEST(Raycast, TheParameterGrowsFromRootToTip) {
  RaycastScene scene = scene_at(40, 40, {0, 0, 4});
  scene.strand_paint = [](std::uint32_t, float t) { return Paint{glm::vec3(t), 1}; };
  const RaycastResult found = raycast(scene, {straight({0, -1, 0}, {0, 1, 0}, 0.5f)}, {.samples = 1});
  for (const int y : {6, 13, 20, 27, 34}) {
    const glm::vec4 pixel = found.picture.pixel[std::size_t(y) * 40 + 20];
    if (pixel.w < 1) continue;
    const float height = (19.5f - float(y)) * 3.75f * scene.camera.pixel;  // at the front of the strand
    EXPECT_NEAR(pixel.x, 0.5f + 0.5f * height, 0.02f) << y;
  }
  EXPECT_EQ(found.picture.pixel[20 * 40 + 20].w, 1);
}

TEST(Raycast, EachStrandOfARowIsEnteredOnce) {
  RaycastScene scene = scene_at(1, 1, {0, 0, 4}, {glm::vec3(1), 0.1f});
  std::vector<DrawnStrand> strands;
  strands.reserve(20);
  for (int i = 0; i < 20; ++i)
    strands.push_back(straight({0, -1, -1 + 0.1f * float(i)}, {0, 1, -1 + 0.1f * float(i)}, 0.05f));
  EXPECT_EQ(raycast(scene, strands, {.cones = 7, .samples = 1}).hits, 20u);
}

TEST(Raycast, TheCurvesOfAStrandAreEnteredOnce) {
  const RaycastScene scene = scene_at(9, 9, {0, 0, 4}, {glm::vec3(1), 0.5f});
  std::vector<DrawnStrand> curves{straight({0, -1, 0}, {0, 0, 0}, 1), straight({0, 0, 0}, {0, 1, 0}, 1)};
  const auto most = [&] {
    float alpha = 0;
    for (const glm::vec4& pixel : raycast(scene, curves, {.cones = 4, .samples = 1}).picture.pixel)
      alpha = std::max(alpha, pixel.w);
    return alpha;
  };
  EXPECT_EQ(most(), 0.75f) << "two strands that meet";
  curves[0].part = StrandPart{.from = 0, .to = 0.5f, .strand = 7};
  curves[1].part = StrandPart{.from = 0.5f, .to = 1, .strand = 7};
  EXPECT_EQ(most(), 0.5f) << "one strand";
}

TEST(Raycast, TheSkinHidesWhatIsBehindIt) {
  auto skin = std::make_shared<Mesh>();
  skin->position = {{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}};
  skin->triangle = {{0, 1, 2}};
  RaycastScene scene = scene_at(9, 9, {0, 0, 4});
  scene.skin = skin;
  scene.skin_paint = [](std::uint32_t, glm::vec2) { return Paint{{0, 0, 1}, 1}; };
  const std::vector<DrawnStrand> behind{straight({0, -1, -0.5f}, {0, 1, -0.5f}, 0.5f)},
      before{straight({0, -1, 0.5f}, {0, 1, 0.5f}, 0.5f)};
  EXPECT_EQ(raycast(scene, behind, {.samples = 1}).hits, 0u);
  const glm::vec4 centre = raycast(scene, behind, {.samples = 1}).picture.pixel[40];
  EXPECT_EQ(centre, glm::vec4(0, 0, 1, 1));
  EXPECT_EQ(raycast(scene, before, {.samples = 1}).picture.pixel[40], glm::vec4(1));
}

// Pictures of thin strands by both methods have the same mean coverage. The reference draws strips that face
// the camera, and a pixel's coverage is a box filter, so single pixels differ. The alpha
// of a strip is linear in each of its 7 segments, which loses 0.7% of the coverage, and the ray-cast strands
// have round ends, which add 0.6%.
TEST(Raycast, HasTheCoverageOfTheReference) {
  RaycastScene scene = scene_at(300, 225, {0.5f, 0.6f, 3.4f});
  Look look;
  look.segments = 7;
  look.opacity = 1;
  look.taper = 0.5f;
  scene.radius = [](std::uint32_t, float t) { return 0.003f * (1 - 0.5f * t); };
  scene.strand_paint = [](std::uint32_t, float t) { return Paint{glm::vec3(0.5f), 1 - t * t * t}; };
  std::vector<DrawnStrand> strands;
  std::vector<Entry> order;
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (std::uint32_t i = 0; i < 60; ++i) {
    const glm::vec3 root(1.2f * unit(random), 0.8f * unit(random), unit(random));
    const glm::vec3 step(0.5f + 0.4f * unit(random), 0.9f * unit(random), 0.1f * unit(random));
    DrawnStrand s = straight(root, root + step, 0.006f);
    s.point[1] += glm::vec3(0.05f * unit(random), 0.05f * unit(random), 0);
    strands.push_back(s);
    order.push_back({0, i});
  }
  const double exact = covered(raycast(scene, strands, {.samples = 8}).picture);
  const double drawn = covered(reference::draw(scene.camera, look, strands, order));
  EXPECT_GT(exact, 100);
  EXPECT_NEAR(drawn, exact, 0.03 * exact);
}

}  // namespace
}  // namespace pelage::strands
