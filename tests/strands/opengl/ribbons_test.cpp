// Compares the OpenGL baseline's pictures of strands with the double-precision reference.
#include "harness/strands/opengl/ribbons.hpp"

#include <gtest/gtest.h>

#include "harness/compare/metrics.hpp"
#include "harness/error.hpp"
#include "harness/strands/reference/drawing.hpp"
#include "tests/strands/support/ball.hpp"

namespace pelage::strands {
namespace {

double psnr_of(const DrawingScene& scene, const Ball& ball, const RibbonOptions& options) {
  Ribbons ribbons(scene, ball.strands, options);
  EXPECT_GT(ribbons.frame(ball.keys), 0);
  std::vector<DrawnStrand> drawn;
  for (const KeyedStrand& s : ball.strands)
    drawn.push_back(reference::between(ball.keys, s, scene.first_segment));
  const std::vector<Entry> order = reference::drawing_order(scene.camera, scene.range, drawn);
  // The baseline interpolates in other roundings, so single strands at the limits may differ.
  EXPECT_NEAR(double(ribbons.drawn()), double(order.size()), 3);
  return compare(ribbons.read(), reference::draw(scene.camera, scene.look, drawn, order)).psnr;
}

TEST(Ribbons, AgreeWithTheReference) {
  const Ball ball(700, 2);
  for (const char* expand : {"instanced", "indexed"}) {
    EXPECT_GE(psnr_of(ball_scene(333, 250), ball, {expand, "rgba32f"}), 50) << expand;
    EXPECT_GE(psnr_of(ball_scene(333, 250), ball, {expand, "rgba16f"}), 45) << expand;
  }
}

TEST(Ribbons, NothingIsDrawnOfStrandsBeyondThePicture) {
  DrawingScene scene = ball_scene(100, 80);
  Ball ball(20);
  for (KeyStrand& key : ball.keys) key.root += glm::vec3(50, 0, 0);
  Ribbons ribbons(scene, ball.strands);
  ribbons.frame(ball.keys);
  EXPECT_EQ(ribbons.drawn(), 0u);
  for (const glm::vec4& pixel : ribbons.read().pixel) EXPECT_EQ(pixel, glm::vec4(scene.look.background, 0));
}

TEST(Ribbons, WrongOptionsAreRefused) {
  const Ball ball(5);
  EXPECT_THROW(Ribbons(ball_scene(50, 50), ball.strands, {"strips"}), InputError);
  EXPECT_THROW(Ribbons(ball_scene(50, 50), ball.strands, {"indexed", "rgb8"}), InputError);
}

}  // namespace
}  // namespace pelage::strands
