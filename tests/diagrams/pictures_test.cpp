// Tests what the pictures of masks, textures and strands contain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/compare/frame_output.hpp"
#include "harness/diagrams/diagrams.hpp"
#include "harness/error.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

Picture black(int width, int height) {
  return {width, height, std::vector<glm::vec4>(std::size_t(width) * std::size_t(height), {0, 0, 0, 1})};
}

FrameInput square_with(std::vector<Droplet> droplets, const std::string& cells) {
  Scene scene = synthetic::lively_scene();
  scene.wetness.size = 64;
  scene.clump.cells = cells;
  FrameInput input = synthetic::frame(scene, synthetic::square(1), 2, 2, 0);
  input.droplets = std::move(droplets);
  return input;
}

/// Pixels nearer than this to an edge of the mesh may show the edge.
bool near_an_edge(double u, double v) {
  const auto near = [](double x) { return std::abs(x) < 0.02; };
  return near(u) || near(u - 0.5) || near(u - 1) || near(v) || near(v - 0.5) || near(v - 1) || near(u - v) ||
         near(u + v - 1) || near(std::abs(u - v) - 0.5) || near(std::abs(u + v - 1) - 0.5);
}

TEST(MaskPicture, IsBlueInsideTheDropletAndBlackOutside) {
  const Droplet drop{{0.6f, 0.8f}, 0.15f, 0.5f, {0, 0, 0}, 100.f};
  for (const char* cells : {"consistent", "separate"}) {
    const FrameInput input = square_with({drop}, cells);
    const Picture picture = diagrams::mask_picture(input, reference_motion(input, 0).mask, 256);
    const double slack = 1.0 / 64;  // with "separate", the disc ends at a texel
    int wet = 0;
    for (int y = 0; y < 256; ++y)
      for (int x = 0; x < 256; ++x) {
        const double u = (x + 0.5) / 256, v = 1 - (y + 0.5) / 256, r = std::hypot(u - 0.6, v - 0.8);
        if (near_an_edge(u, v) || std::abs(r - 0.15) < slack) continue;
        const glm::vec3 colour(picture.at(x, y));
        if (r < 0.15) {
          ++wet;
          EXPECT_EQ(colour, diagrams::clump_colour({0.6f, 0.8f, 0.15f, 0.5f}));
        } else {
          EXPECT_EQ(colour, glm::vec3(0));
        }
      }
    EXPECT_GT(wet, 1000);
  }
}

TEST(MaskPicture, ShowsTheMapsEdgesUnlessTheyAreTooShort) {
  const FrameInput input = square_with({}, "consistent");
  const std::vector<glm::vec4> dry(std::size_t(64) * 64, glm::vec4(0));
  const Picture large = diagrams::mask_picture(input, dry, 256),
                small = diagrams::mask_picture(input, dry, 8);
  EXPECT_GT(large.at(128, 40).x, 0.1f);  // on the line u = .5
  EXPECT_EQ(large.at(100, 40).x, 0.0f);
  EXPECT_GT(large.at(0, 40).x, 0.5f);  // the border
  EXPECT_EQ(small.at(4, 2).x, 0.0f);   // edges of 4 pixels are left out
}

TEST(MaskPicture, ClumpsAreDarkerIfTheyAreDrierAndDifferInShade) {
  const glm::vec3 wet = diagrams::clump_colour({0.1f, 0.2f, 0.1f, 1.0f}),
                  damp = diagrams::clump_colour({0.1f, 0.2f, 0.1f, 0.25f}),
                  other = diagrams::clump_colour({0.3f, 0.2f, 0.1f, 1.0f});
  EXPECT_EQ(diagrams::clump_colour({0.1f, 0.2f, 0.1f, 0.0f}), glm::vec3(0));
  EXPECT_LT(glm::distance(damp, 0.25f * wet), 1e-6f);
  EXPECT_NE(wet, other);
  EXPECT_GT(wet.b, 2 * wet.r);
}

TEST(Lines, CoverTheirWidthAndStopWhereTheyAreHidden) {
  Picture picture = black(20, 11);
  diagrams::draw_line(picture, {2, 5.5}, {18, 5.5}, 3, {1, 1, 1, 1},
                      [](int, int, double along) { return along < 0.5; });
  EXPECT_EQ(picture.at(5, 5).x, 1.0f);
  EXPECT_EQ(picture.at(5, 4).x, 1.0f);
  EXPECT_EQ(picture.at(5, 7).x, 0.0f);
  EXPECT_EQ(picture.at(15, 5).x, 0.0f);
  EXPECT_NO_THROW(diagrams::draw_line(picture, {-50, -50}, {-40, 300}, 2, {1, 1, 1, 1}));
}

TEST(StrandLines, AreSeenOverTheSurfaceAndHiddenBehindIt) {
  Scene scene = synthetic::lively_scene();
  scene.fur.length = 0.3f;
  scene.fur.comb = scene.fur.comb_noise = 0;
  scene.dynamics.wind.strength = 0;
  for (const float side : {1.0f, -1.0f}) {
    scene.camera.framed = false;
    scene.camera.eye = {0.1f, 0.4f, side * 3.0f};  // in front of the square, then behind it
    scene.camera.target = {0, 0, 0};
    scene.camera.up = {0, 1, 0};
    FrameInput input = synthetic::frame(scene, synthetic::square(2), 1, 1, 0);
    input.camera = synthetic::camera(scene.camera, 160, 100);
    const auto curves = diagrams::strand_curves(input, reference_motion(input, 1).tips, 100);
    ASSERT_EQ(curves.size(), 2u);
    EXPECT_LT(glm::distance(curves[0].front(), glm::dvec3(input.strands.root[0])), 1e-6);
    EXPECT_NEAR(glm::distance(curves[0].front(), curves[0].back()), 0.3, 1e-5);
    Picture picture = black(160, 100);
    diagrams::draw_strands(picture, input, curves, 2);
    const auto white = std::count_if(picture.pixel.begin(), picture.pixel.end(),
                                     [](const glm::vec4& p) { return p.x > 0.5f; });
    if (side > 0)
      EXPECT_GT(white, 5);
    else
      EXPECT_LE(white, 4);  // only the roots, which lie on the surface
  }
}

TEST(StrandLines, AreThinnedToTheGivenNumber) {
  const FrameInput input = synthetic::frame(synthetic::lively_scene(), synthetic::torus(), 8, 8, 0);
  const std::vector<glm::vec3> tips = reference_motion(input, 1).tips;
  EXPECT_EQ(diagrams::strand_curves(input, tips, 10).size(), 10u);
  EXPECT_EQ(diagrams::strand_curves(input, tips, 100000).size(), tips.size());
}

TEST(WindArrow, PointsAlongTheWind) {
  Scene scene = synthetic::lively_scene();
  scene.camera.framed = false;
  scene.camera.eye = {0, 0, 3};
  scene.camera.target = {0, 0, 0};
  for (const float x : {1.0f, -1.0f}) {
    scene.dynamics.wind.direction = {x, 0, 0};
    FrameInput input = synthetic::frame(scene, synthetic::square(2), 1, 1, 0);
    input.camera = synthetic::camera(scene.camera, 160, 80);
    Picture picture = black(160, 80);
    diagrams::draw_wind_arrow(picture, input, 1);
    // The arrow is 20 pixels long, with its middle at (80, 10). Its head is the part above and below the row
    // of the shaft.
    int left = 160, right = 0, head = 0, pixels = 0;
    for (int row = 0; row < 80; ++row)
      for (int column = 0; column < 160; ++column) {
        if (!(picture.at(column, row).x > 0.3f)) continue;
        left = std::min(left, column);
        right = std::max(right, column);
        pixels += 1;
        if (std::abs(row + 0.5 - 10) > 1.5) head += column < 80 ? -1 : 1;
      }
    EXPECT_NEAR(left, 70, 1.5);
    EXPECT_NEAR(right, 89, 1.5);
    EXPECT_GT(pixels, 25);
    EXPECT_GE(int(x) * head, 4);
  }
}

TEST(WindArrow, NeedsWind) {
  Scene scene = synthetic::lively_scene();
  scene.dynamics.wind.strength = 0;
  const FrameInput input = synthetic::frame(scene, synthetic::square(2), 1, 1, 0);
  Picture picture = black(input.camera.width, input.camera.height);
  EXPECT_THROW(diagrams::draw_wind_arrow(picture, input, 1), InputError);
}

TEST(Textures, ShowTheirTexelsWithTheTopRowAtVOne) {
  CoatTexture coat{2, {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {51, 51, 51, 255}}};
  const Picture picture = diagrams::coat_picture(coat);
  EXPECT_EQ(picture.at(0, 1), glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(picture.at(0, 0), glm::vec4(0, 0, 1, 1));
  EXPECT_NEAR(picture.at(1, 0).x, 0.2f, 1e-6f);

  FurTexture fur{2, 8, {std::vector<std::array<std::uint8_t, 2>>(std::size_t(8) * 4, {0, 0})}};
  fur.level[0][(7 * 2 + 0) * 2 + 1] = {255, 255};  // last layer, row v = 0, column 1
  const Picture slices = diagrams::slices_picture(fur);
  ASSERT_EQ(slices.width, 4 * 256 + 3 * 8);
  EXPECT_EQ(slices.at(slices.width - 1, 255).x, 1.0f);
  EXPECT_EQ(
      std::count_if(slices.pixel.begin(), slices.pixel.end(), [](const glm::vec4& p) { return p.x > 0; }),
      128 * 128 + 3 * 8 * 256);                   // the texel, and the lines between the slices
  fur.level[0][(1 * 2 + 1) * 2 + 0] = {255, 51};  // darker; the brightest texel of all slices stays white
  EXPECT_NEAR(diagrams::slices_picture(fur).at(0, 0).x, std::sqrt(0.2f), 1e-6f);
}

}  // namespace
}  // namespace pelage
