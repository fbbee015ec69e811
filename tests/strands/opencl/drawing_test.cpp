// Compares the device's pictures of strands with the double-precision reference: the control points, the list
// of strands to draw, and the picture. The device must also give equal bits for every division of the work.
#include "harness/strands/reference/drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "harness/strands/scene/strand_input.hpp"
#include "tests/strands/support/device_picture.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::strands {
namespace {

void expect_reference(const DrawingScene& scene, const Ball& ball, const DrawerOptions& options = {}) {
  const DevicePicture device = draw_on_device(scene, ball, options);
  for (std::size_t i = 0; i < ball.strands.size(); ++i) {
    const DrawnStrand expected = reference::between(ball.keys, ball.strands[i], scene.first_segment);
    // The angles of twist and curvature have 16 bits on the device.
    const float limit = has_styles(ball.strands) ? 3e-5f : 2e-6f;
    for (std::size_t k = 0; k < 3; ++k)
      ASSERT_LT(glm::length(device.curves[i].point[k] - expected.point[k]), limit) << i << ", point " << k;
    ASSERT_LT(glm::length(device.curves[i].normal - expected.normal), limit) << i;
  }
  expect_reference_picture(scene, device);
}

TEST(StrandDrawing, IsThatOfTheReference) {
  expect_reference(ball_scene(333, 250), Ball(1000));
}

TEST(StrandDrawing, ManyStrandsCloseTheirPixels) {
  expect_reference(ball_scene(200, 130), Ball(20000));
}

// A strand is left out behind blocks whose pixels have a transmittance of at most 1/512. The blocks of tiles
// of 128 pixels are twice as wide as those of other tiles, so other strands are left out.
TEST(StrandDrawing, ClosedBlocksHideNoVisibleStrand) {
  const DrawingScene scene = ball_scene(200, 130);
  const Ball ball(60000);
  const Picture a = draw_on_device(scene, ball, {.mapping = Drawing::item, .tile = 64}).picture,
                b = draw_on_device(scene, ball, {.mapping = Drawing::item, .tile = 128}).picture;
  constexpr float most = 1.0f / 128;  // more than 1/512 of the brightest colour
  for (std::size_t i = 0; i < a.pixel.size(); ++i)
    for (int k = 0; k < 4; ++k) ASSERT_LT(std::abs(a.pixel[i][k] - b.pixel[i][k]), most) << "pixel " << i;
}

TEST(StrandDrawing, RanksComeBeforeDepths) {
  DrawingScene scene = ball_scene(200, 130);
  scene.look.segments = 5;
  scene.look.exponent = 17.5f;
  expect_reference(scene, Ball(600, 3));
}

// The second segment of each strand lies on the first one, so that the strand covers its pixels twice, and
// the angle of the strip and the tangent at its fold are those of docs/strands.md. If the segments were
// blended in another order, or rounding errors selected a direction at the fold, the PSNR would be about 60
// dB.
TEST(StrandDrawing, StrandsThatTurnBackAreBlendedFromTheirRoots) {
  Ball ball(700);
  for (KeyStrand& key : ball.keys) key.first = key.second = key.rest;
  for (KeyedStrand& strand : ball.strands) {
    strand.curvature = 175;
    strand.width = 0.04f;
  }
  for (const Drawing mapping : {Drawing::item, Drawing::group})
    for (const int segments : {4, 6, 7}) {
      DrawingScene scene = ball_scene(333, 250);
      scene.first_segment = 0.5f;
      scene.look.segments = segments;
      scene.look.opacity = 0.6f;
      const DevicePicture device = draw_on_device(scene, ball, {.mapping = mapping});
      const auto folded = std::count_if(device.curves.begin(), device.curves.end(), [](const DrawnStrand& s) {
        return glm::distance(s.point[0], s.point[2]) < 1e-5f;
      });
      EXPECT_GT(folded, 500);
      const Agreement found =
          compare(device.picture, reference::draw(scene.camera, scene.look, device.curves, device.order));
      EXPECT_GT(found.psnr, tolerance::folded_psnr)
          << segments << " segments, worst pixel " << found.worst_x << " " << found.worst_y;
    }
}

/// A look with all kinds of light.
Look bright() {
  Look look;
  look.fills = {{{1, 0.2f, 0.3f}, {0.5f, 0.2f, 0.1f}}, {{-0.4f, -1, 0.6f}, {0.1f, 0.3f, 0.6f}}};
  look.rim = {0.5f, 0.4f, 0.3f};
  look.rim_exponent = 2.5f;
  look.skin_shadow = 0.7f;
  look.skin_shadow_height = 0.6f;
  std::mt19937 random(3);
  look.film.resize(5);
  for (FilmFrame& frame : look.film)
    for (FilmSample& sample : frame)
      sample = {std::uint8_t(random() & 255), std::uint8_t(random() & 255), std::uint8_t(random() & 255)};
  return look;
}

TEST(StrandDrawing, AllLightsAgreeWithTheReference) {
  DrawingScene scene = ball_scene(200, 130);
  scene.look = bright();
  for (const int bands : {1, 2})
    for (const Drawing mapping : {Drawing::item, Drawing::group}) {
      scene.look.bands = bands;
      expect_reference(scene, Ball(800), {.mapping = mapping});
    }
}

// Layers have ranks in another order than their numbers, and frames of their own.
TEST(StrandDrawing, LayersHaveTheirRanksAndTheirFramesOfTheFilmStrip) {
  DrawingScene scene = ball_scene(200, 130);
  scene.look = bright();
  scene.look.layers = {{2, 3, 2}, {0, 0, 1}, {1, 1, 3}};
  const Ball ball(800, 4);  // layer 3 has no entry: it has the rank 3 and all frames
  for (const int lanes : {1, 16}) expect_reference(scene, ball, {.lanes = lanes});
  const DevicePicture first = draw_on_device(scene, ball);
  const std::vector<int> ranks{2, 0, 1, 3};
  for (const Entry& entry : first.order)
    ASSERT_EQ(int(entry.key >> 24), ranks[ball.strands[entry.strand].layer]);
  scene.look.layers[1].first_frame = 4;
  EXPECT_NE(draw_on_device(scene, ball).picture.pixel, first.picture.pixel);
}

TEST(StrandDrawing, FramesOutsideOfTheFilmStripAreRefused) {
  DrawingScene scene = ball_scene(100, 100);
  scene.look = bright();
  for (const LayerLook wrong : {LayerLook{0, 5, 1}, LayerLook{0, 3, 3}, LayerLook{0, -1, 1},
                                LayerLook{0, 0, 0}, LayerLook{256, 0, 1}}) {
    scene.look.layers = {wrong};
    EXPECT_THROW(draw_on_device(scene, Ball(10)), InputError);
  }
}

TEST(StrandDrawing, StylesAgreeWithTheReference) {
  Ball ball(800);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> part(-1, 1);
  for (KeyedStrand& s : ball.strands) {
    s.response = 1 + 0.9f * part(random);
    s.twist = 180 * part(random);
    s.curvature = 120 * part(random);
  }
  expect_reference(ball_scene(200, 130), ball);
}

// The near plane cuts the fur in front of the sphere.
DrawingScene cut_scene(float near) {
  DrawingScene scene = ball_scene(150, 120, {0.3f, 0.4f, 1.6f}, near);
  scene.look.segments = 7;
  return scene;
}

TEST(StrandDrawing, StrandsAreCutAtTheNearPlane) {
  for (const float near : {0.55f, 0.65f}) {
    const DrawingScene scene = cut_scene(near);
    const Ball ball(2000);
    const std::vector<DrawnStrand> curves = draw_on_device(scene, ball).curves;
    const auto behind = [&](glm::vec3 p) {
      return glm::dot(scene.camera.row_w, glm::vec4(p, 1)) < scene.camera.near;
    };
    const auto cut = std::count_if(curves.begin(), curves.end(), [&](const DrawnStrand& s) {
      return behind(s.point[0]) != behind(s.point[2]);
    });
    EXPECT_GT(cut, 20);
    expect_reference(scene, ball);
  }
}

TEST(StrandDrawing, EveryLayoutAgreesWithTheReference) {
  for (const DrawerOptions& options :
       {DrawerOptions{.lanes = 1}, DrawerOptions{.tile = 16}, DrawerOptions{.tile = 32}})
    expect_reference(ball_scene(200, 130), Ball(500), options);
  // Processors without AVX-512 use eight lanes.
  for (const int tile : {32, 64, 128})
    expect_reference(ball_scene(200, 130), Ball(3000),
                     {.mapping = Drawing::item, .tile_lanes = 8, .tile = tile});
  expect_reference(ball_scene(200, 130), Ball(700, 2), {.mapping = Drawing::group});
  expect_reference(cut_scene(0.6f), Ball(2000), {.mapping = Drawing::group, .lanes = 1});
}

TEST(StrandDrawing, APictureShowsTheKeysOfItsFrame) {
  const DrawingScene scene = ball_scene(300, 200);
  const Ball ball(500);
  const std::vector<KeyStrand>& still = ball.keys;
  std::vector<KeyStrand> moved = still, away = still;
  for (KeyStrand& key : moved) key.first = glm::normalize(key.first + glm::vec3(0.3f, -0.4f, 0.2f));
  for (KeyStrand& key : away) key.root += glm::vec3(50, 0, 0);
  const auto fresh = [&](const std::vector<KeyStrand>& keys) {
    return draw_on_device(scene, ball.strands, keys).picture.pixel;
  };
  Drawer drawer(test::queue(), scene, ball.strands, ball.keys.size());
  for (const std::vector<KeyStrand>& keys : {still, moved, away, moved, still})
    EXPECT_EQ(drawn_with(drawer, keys).pixel, fresh(keys));
  for (const glm::vec4& pixel : fresh(away)) ASSERT_EQ(pixel, glm::vec4(scene.look.background, 0));
}

TEST(StrandDrawing, BitsDoNotDependOnTheDivisionOfTheWork) {
  const Ball ball(3001, 2);
  const DrawingScene scene = ball_scene(300, 200);
  const DevicePicture first = draw_on_device(scene, ball);
  for (const int runs : {1, 7, 64})
    for (const int chunks : {1, 5, 33}) {
      const DevicePicture other = draw_on_device(scene, ball, {.runs = runs, .chunks = chunks});
      EXPECT_EQ(other.order, first.order);
      EXPECT_EQ(other.picture.pixel, first.picture.pixel) << runs << " runs, " << chunks << " chunks";
    }
}

TEST(StrandDrawing, WrongValuesAreRefused) {
  const Ball ball(10);
  DrawingScene scene = ball_scene(100, 100);
  for (const DrawerOptions& wrong : {DrawerOptions{.mapping = Drawing::item, .lanes = 3},
                                     DrawerOptions{.mapping = Drawing::item, .tile_lanes = 4},
                                     DrawerOptions{.mapping = Drawing::item, .runs = -1},
                                     DrawerOptions{.mapping = Drawing::item, .chunks = 70000},
                                     DrawerOptions{.mapping = Drawing::item, .tile = 65},
                                     DrawerOptions{.mapping = Drawing::group, .tile = 32}})
    EXPECT_THROW(draw_on_device(scene, ball, wrong), InputError);
  scene.first_segment = 1;
  EXPECT_THROW(draw_on_device(scene, ball), InputError);
  scene = ball_scene(100, 100);
  Ball wrong(10);
  wrong.strands[3].key[1] = 30;
  EXPECT_THROW(draw_on_device(scene, wrong), InputError);
  wrong = ball;
  wrong.strands[3].length = std::nanf("");
  EXPECT_THROW(draw_on_device(scene, wrong), InputError);
  wrong = ball;
  wrong.strands.clear();
  EXPECT_THROW(draw_on_device(scene, wrong), InputError);
}

// Compares the device's pictures of strands above a skin with the double-precision reference.

std::shared_ptr<const Mesh> torus() {
  return std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 40, 24));
}

/// A torus with short strands and all kinds of light.
Scene scene_with(int strands) {
  Scene scene;
  scene.model = "torus";
  scene.image.width = 210;
  scene.image.height = 150;
  scene.strands.rim = glm::vec3(0.2f);
  scene.strands.layers.front().count = strands;
  scene.strands.layers.front().length = 0.08f;
  return scene;
}

DevicePicture draw(const Scene& scene, const DrawerOptions& options = {}) {
  const auto input = prepare_strands(scene, torus());
  return draw_on_device(*input, input->fur.strands, input->fur.keys, options);
}

void expect_agreement(const Scene& scene, const DrawerOptions& options = {}) {
  expect_reference_picture(*prepare_strands(scene, torus()), draw(scene, options));
}

double changed(const Picture& a, const Picture& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixel.size(); ++i) count += a.pixel[i] != b.pixel[i];
  return double(count) / double(a.pixel.size());
}

TEST(SkinPicture, IsThatOfTheReference) {
  for (const Drawing mapping : {Drawing::item, Drawing::group})
    expect_agreement(scene_with(3000), {.mapping = mapping});
}

TEST(SkinPicture, WithFewLightsIsThatOfTheReference) {
  Scene scene = scene_with(500);
  scene.strands.rim = glm::vec3(0);
  scene.strands.skin_shadow = 0;
  scene.strands.shadow = "none";
  scene.shading.lights.resize(1);
  expect_agreement(scene);
}

TEST(SkinPicture, InsideTheObjectIsThatOfTheReference) {
  Scene scene = scene_with(2000);
  scene.camera.framed = false;
  scene.camera.eye = {0.62f, 0.1f, 0.1f};  // triangles cross the near plane
  scene.camera.target = {0, 0, 0.7f};
  expect_agreement(scene);
}

TEST(SkinPicture, HidesStrandsAndIsOpaque) {
  Scene scene = scene_with(300);
  const Picture with = draw(scene).picture;
  scene.strands.skin = false;
  const Picture without = draw(scene).picture;
  std::size_t opaque = 0, opaque_without = 0;
  for (const glm::vec4& pixel : with.pixel) opaque += pixel.w == 1.0f;
  for (const glm::vec4& pixel : without.pixel) opaque_without += pixel.w == 1.0f;
  EXPECT_GT(opaque, with.pixel.size() / 10);
  EXPECT_LT(opaque_without, opaque / 10);
  EXPECT_GT(changed(with, without), 0.1);
}

TEST(SkinPicture, HasEqualBitsInEveryRunAndDivision) {
  const Scene scene = scene_with(3000);
  const Picture first = draw(scene).picture;
  for (const int chunks : {1, 7, 64}) EXPECT_EQ(draw(scene, {.chunks = chunks}).picture.pixel, first.pixel);
}

// A frame after another camera must not keep blocks of the picture before it.
TEST(SkinPicture, FollowsTheCamera) {
  Scene scene = scene_with(400);
  const auto near = prepare_strands(scene, torus());
  scene.camera.framed = false;
  scene.camera.eye = {2.8f, 2.5f, 5.0f};
  const auto far = prepare_strands(scene, torus());
  DrawingScene shown = *far;
  shown.skin = near->skin;
  const auto far_picture = [&](bool near_first) {
    Drawer drawer(test::queue(), near_first ? DrawingScene(*near) : shown, near->fur.strands,
                  near->fur.keys.size());
    if (near_first) {
      drawn_with(drawer, near->fur.keys);
      drawer.set_view(shown);
    }
    return drawn_with(drawer, near->fur.keys);
  };
  EXPECT_EQ(far_picture(true).pixel, far_picture(false).pixel);
}

}  // namespace
}  // namespace pelage::strands
