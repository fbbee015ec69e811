// Tests the controls of D that a layer or a strand has for itself on the device: look and damping of a fur
// layer, strands that face away from the camera, and the number of segments of a strand.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "harness/error.hpp"
#include "tests/strands/support/device_picture.hpp"

namespace pelage::strands {
namespace {

/// Three layers; two have looks of their own.
std::vector<LayerLook> own_looks() {
  return {{.rank = 2, .opacity = 0.5f, .taper = 0.3f, .gloss = 0, .rim = {2, 0.5f, 0}, .rim_exponent = 0.5f},
          {.rank = 0,
           .opacity = 1.1f,
           .taper = 1.1f,
           .gloss = 3,
           .exponent = 0.3f,
           .rim = {0, 0, 4},
           .skin_shadow = 0.5f},
          {.rank = 1}};
}

DrawingScene scene_of_layers() {
  DrawingScene scene = ball_scene(200, 130);
  scene.look.rim = {0.3f, 0.3f, 0.2f};
  scene.look.skin_shadow = 0.6f;
  scene.look.layers = own_looks();
  return scene;
}

TEST(LayerLooks, AreThoseOfTheReference) {
  DrawingScene scene = scene_of_layers();
  const Ball ball(800, 3);
  for (const Drawing mapping : {Drawing::item, Drawing::group})
    for (const int lanes : {1, 16}) {
      const DrawerOptions options{.mapping = mapping, .lanes = lanes};
      expect_reference_picture(scene, draw_on_device(scene, ball, options));
    }
  const Picture first = draw_on_device(scene, ball).picture;
  for (const auto& change : std::vector<std::function<void(LayerLook&)>>{
           [](LayerLook& l) { l.opacity = 0.9f; }, [](LayerLook& l) { l.taper = 0.8f; },
           [](LayerLook& l) { l.gloss = 1; }, [](LayerLook& l) { l.rim.z = 1; },
           [](LayerLook& l) { l.exponent = 1; }, [](LayerLook& l) { l.rim_exponent = 2; },
           [](LayerLook& l) { l.skin_shadow = 1.5f; }}) {
    scene.look.layers = own_looks();
    change(scene.look.layers[1]);
    EXPECT_NE(draw_on_device(scene, ball).picture.pixel, first.pixel);
  }
}

// Each layer has its own copies of its frames on the device. The shadow of a strand depends on its opacity.
TEST(LayerLooks, GoWithFilmStripsAndShadows) {
  DrawingScene scene = scene_of_layers();
  scene.look.shadow = {Shadow::exponential, 128, 0.2f, 1 + longest};
  std::mt19937 random(3);
  scene.look.film.resize(5);
  for (FilmFrame& frame : scene.look.film)
    for (FilmSample& sample : frame)
      sample = {std::uint8_t(random() & 255), std::uint8_t(random() & 255), std::uint8_t(random() & 255)};
  for (auto [layer, first, frames] : {std::array{0, 3, 2}, {1, 0, 4}, {2, 2, 1}}) {
    scene.look.layers[std::size_t(layer)].first_frame = first;
    scene.look.layers[std::size_t(layer)].frames = frames;
  }
  const Ball ball(800, 3);
  expect_reference_picture(scene, draw_on_device(scene, ball));
  scene.look.film.resize(256);
  scene.look.layers[0].first_frame = 0;
  scene.look.layers[0].frames = 256;
  EXPECT_THROW(draw_on_device(scene, ball), InputError) << "more than 256 frames";
}

TEST(LayerLooks, OfEqualFactorsArePicturesOfTheCommonLook) {
  DrawingScene scene = ball_scene(200, 130);
  const Ball ball(500, 2);
  scene.look.rim = {0.25f, 0.25f, 0.25f};
  scene.look.layers = {{.rank = 0}, {.rank = 1}};
  scene.look.opacity = 0.5f;
  scene.look.taper = 0.25f;
  scene.look.exponent = 17.5f;  // not a whole number, for which the kernels multiply
  scene.look.rim_exponent = 3;
  scene.look.skin_shadow = 0.5f;
  const Picture common = draw_on_device(scene, ball).picture;
  for (LayerLook& layer : scene.look.layers) {
    layer.opacity = 0.5f;
    layer.taper = layer.gloss = layer.exponent = layer.skin_shadow = layer.rim_exponent = 2;
    layer.rim = glm::vec3(0.5f);
  }
  scene.look.opacity = 1;
  scene.look.taper = 0.125f;
  scene.look.specular *= 0.5f;
  scene.look.rim *= 2.0f;
  scene.look.exponent /= 2;
  scene.look.rim_exponent /= 2;
  scene.look.skin_shadow /= 2;
  EXPECT_EQ(draw_on_device(scene, ball).picture.pixel, common.pixel) << "powers of 2 are exact";
}

TEST(LayerLooks, WrongValuesAreRefused) {
  const Ball ball(10);
  EXPECT_THROW(draw_on_device(scene_of_layers(), Ball(100, 4)), InputError) << "a layer without an entry";
  for (const LayerLook& wrong :
       {LayerLook{.opacity = 1.2f}, LayerLook{.opacity = -1}, LayerLook{.taper = 1.2f},
        LayerLook{.gloss = -1}, LayerLook{.rim = {0, -1, 0}}, LayerLook{.exponent = 0.001f},
        LayerLook{.rim_exponent = 0.1f}, LayerLook{.skin_shadow = -1}}) {
    DrawingScene scene = ball_scene(100, 100);
    scene.look.skin_shadow = 0.5f;
    scene.look.layers = {wrong};
    EXPECT_THROW(draw_on_device(scene, ball), InputError);
  }
}

TEST(BackFacing, LastGivesTheBitsOfRemoved) {
  DrawingScene scene = ball_scene(200, 130);
  for (const int layers : {1, 3, 1}) {
    const Ball ball(2003, layers);
    scene.look.back_facing = BackFacing::removed;
    const DevicePicture removed = draw_on_device(scene, ball);
    scene.look.back_facing = BackFacing::last;
    for (const Drawing mapping : {Drawing::item, Drawing::group})
      for (const int chunks : {1, 5, 33}) {
        const DevicePicture last = draw_on_device(scene, ball, {.mapping = mapping, .chunks = chunks});
        EXPECT_EQ(last.order, removed.order);
        if (mapping == Drawing::item) {
          EXPECT_EQ(last.picture.pixel, removed.picture.pixel) << chunks;
        }
      }
    expect_reference_picture(scene, draw_on_device(scene, ball));
    scene.range.per_depth = 1e9f;  // in the next round, most strands have the last depth step
  }
}

TEST(BackFacing, DrawnIsThatOfTheReference) {
  DrawingScene scene = ball_scene(200, 130);
  const Ball ball(800);
  const std::size_t facing = draw_on_device(scene, ball).order.size();
  scene.look.back_facing = BackFacing::drawn;
  for (const Drawing mapping : {Drawing::item, Drawing::group})
    expect_reference_picture(scene, draw_on_device(scene, ball, {.mapping = mapping}));
  EXPECT_GT(draw_on_device(scene, ball).order.size(), facing + 200);
}

/// The number of segments that each strand of a picture needs (docs/strands.md, section Segments).
std::set<int> segments_in(const DrawingScene& scene, const DevicePicture& device) {
  std::set<int> found;
  for (const Entry& entry : device.order) {
    const auto& p = device.curves[entry.strand].point;
    const glm::vec3 bend = p[0] - 2.0f * p[1] + p[2];
    float nearest = 1e9f;
    for (const glm::vec3& point : p)
      nearest = std::min(nearest, glm::dot(scene.camera.row_w, glm::vec4(point, 1)));
    const float pixels = glm::length(bend) / (nearest * scene.camera.pixel);
    found.insert(std::clamp(int(std::ceil(std::sqrt(pixels))), 3, 7));
  }
  return found;
}

TEST(OwnSegments, AreThoseOfTheReference) {
  DrawingScene scene = ball_scene(333, 250);
  const Ball ball(1500);
  scene.look.segments = 7;
  const Picture fixed = draw_on_device(scene, ball).picture;
  scene.look.own_segments = true;
  for (const Drawing mapping : {Drawing::item, Drawing::group})
    for (const int lanes : {1, 16}) {
      const DevicePicture device = draw_on_device(scene, ball, {.mapping = mapping, .lanes = lanes});
      EXPECT_GT(segments_in(scene, device).size(), 2u);
      expect_reference_picture(scene, device);
    }
  EXPECT_NE(draw_on_device(scene, ball).picture.pixel, fixed.pixel);
  // Far away, no strand needs more than 3 segments.
  DrawingScene far = ball_scene(120, 90, {3, 4, 30});
  far.look.own_segments = true;
  far.look.segments = 7;
  const DevicePicture three = draw_on_device(far, ball);
  ASSERT_EQ(segments_in(far, three), std::set<int>{3});
  far.look.own_segments = false;
  far.look.segments = 3;
  EXPECT_EQ(three.picture.pixel, draw_on_device(far, ball).picture.pixel);
}

TEST(OwnSegments, OfStrandsAtTheNearPlaneAreThoseOfTheReference) {
  DrawingScene scene = ball_scene(150, 120, {0.3f, 0.4f, 1.6f}, 0.6f);
  scene.look.segments = 7;
  scene.look.own_segments = true;
  for (const Drawing mapping : {Drawing::item, Drawing::group})
    expect_reference_picture(scene, draw_on_device(scene, Ball(2000), {.mapping = mapping}));
}

std::vector<Chain> damped_sphere(std::size_t count) {
  std::vector<Chain> chains = test::sphere_of(count);
  for (std::size_t i = 0; i < count; ++i) {
    chains[i].drag = 0.25f * float(i % 9);
    chains[i].damping = 0.5f * float(i % 7);
  }
  return chains;
}

TEST(OwnDamping, StepsAgreeWithTheReference) {
  test::step_errors(damped_sphere(2000), test::shaken()).expect_small();
}

TEST(OwnDamping, HasTheSameBitsForAllLanesAndIsThatOfTheCommonConstants) {
  const auto run = [&](const std::vector<Chain>& chains, const ChainDynamics& d,
                       const ChainOptions& options) {
    Chains strands(test::queue(), chains, d, options);
    for (int frame = 0; frame < 60; ++frame) strands.enqueue(test::queue(), 4);
    return strands.states(test::queue());
  };
  const std::vector<Chain> own = damped_sphere(333);
  EXPECT_EQ(test::different(run(own, test::shaken(), {16, 1}), run(own, test::shaken(), {1, 3})), 0u);
  // Factors of 2 are exact, and the common constants have the half.
  std::vector<Chain> twice = test::sphere_of(333);
  for (Chain& chain : twice) chain.drag = chain.damping = 2;
  ChainDynamics half = test::shaken();
  half.drag *= 0.5f, half.damping_first *= 0.5f, half.damping_second *= 0.5f;
  const auto a = run(twice, half, {}), b = run(test::sphere_of(333), test::shaken(), {});
  // The sums of the coefficients round differently, so a stop may act one step earlier.
  std::size_t far = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    far += glm::distance(a[i].direction[1], b[i].direction[1]) > 1e-3f;
  EXPECT_LE(far, 3u);
}

}  // namespace
}  // namespace pelage::strands
