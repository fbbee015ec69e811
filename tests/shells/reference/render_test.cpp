// Tests pictures that the reference renders: pictures of which only some rectangles are drawn
// (Options::windows), the clipping of triangles, the 8-bit framebuffer, and opaque fur.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/compare/metrics.hpp"
#include "harness/error.hpp"
#include "tests/support/pictures.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using pictures::small_frame;
using reference::Options;
using reference::render;

Options after(int frames, reference::Mutant mutant = reference::Mutant::none) {
  return {frames, false, {}, {}, mutant};
}

TEST(ReferenceRender, WindowsShowWhatTheWholePictureShows) {
  for (const char* binding : {"shared", "separate"}) {
    const FrameInput input = *small_frame("wet", binding);
    const Picture whole = render(input, after(20));
    Options options = after(20);
    options.windows = fur_windows(whole, 12, 16, 1);
    options.windows.push_back({-5, 90, 30, 30});  // extends beyond the picture
    const Picture parts = render(input, options);
    const Agreement agreement = compare(whole, parts, options.windows);
    EXPECT_EQ(agreement.worst, 0) << binding;
    EXPECT_GT(agreement.pixels, 1000u);
    std::size_t outside = 0;
    for (const glm::vec4& pixel : parts.pixel) outside += pixel == glm::vec4(input.scene.image.background, 0);
    EXPECT_GT(outside, parts.pixel.size() / 2);
  }
}

// A window must show the fur of all faces whose fur may reach it. With a curl radius of five fur lengths,
// some of these faces are far outside the window.
TEST(ReferenceRender, WindowsShowFurThatAWideCurlBringsIn) {
  FrameInput input = *small_frame("curling");
  input.scene.curl.radius = 0.25f;
  input.scene.fur.length = 0.05f;
  const Picture whole = render(input, after(1));
  Options options = after(1);
  options.windows = fur_windows(whole, 12, 16, 1);
  const Agreement agreement = compare(whole, render(input, options), options.windows);
  EXPECT_EQ(agreement.worst, 0);
  EXPECT_GT(agreement.pixels, 1000u);
}

TEST(ReferenceRender, PixelsAreBackgroundFurOrSkin) {
  const FrameInput input = *small_frame("curling");
  const Picture picture = render(input, after(10));
  std::size_t background = 0, skin = 0, fur = 0;
  for (const glm::vec4& pixel : picture.pixel) {
    ASSERT_TRUE(pixel.w >= 0 && pixel.w <= 1);
    background += pixel.w == 0;
    skin += pixel.w == 1;
    fur += pixel.w > 0 && pixel.w < 1;
    if (pixel.w == 0) {
      ASSERT_EQ(glm::vec3(pixel), input.scene.image.background);
    }
  }
  EXPECT_GT(background, 1000u);
  EXPECT_GT(skin, 1000u);
  EXPECT_GT(fur, 300u);
}

TEST(ReferenceRender, EightBitsRoundEveryPixelAndStayNear) {
  FrameInput input = *small_frame("curling");
  // The PSNR limit below was determined with grey highlights and grey skin.
  input.scene.shading.specular = glm::vec3(.2f);
  input.scene.coat.skin = glm::vec3(.5f);
  Options options = after(10);
  const Picture exact = render(input, options);
  options.eight_bit = true;
  const Picture rounded = render(input, options);
  for (const glm::vec4& pixel : rounded.pixel)
    for (int c = 0; c < 4; ++c) {
      const double steps = double(pixel[c]) * 255;
      ASSERT_NEAR(steps, std::round(steps), 1e-4);
      ASSERT_TRUE(pixel[c] >= 0 && pixel[c] <= 1);
    }
  const Agreement agreement = compare(exact, rounded);
  EXPECT_GT(agreement.worst, .5 / 255);
  EXPECT_GT(agreement.psnr, 35);
}

/// Returns a scene with the camera close above a square. The square extends behind the camera.
Scene skimming_scene() {
  Scene scene = synthetic::upright_scene();
  scene.fur.length = .02f;
  scene.camera.eye = {.13f, -.21f, .25f};
  scene.camera.target = {.3f, 1.2f, 0};
  scene.camera.up = {0, 0, 1};
  scene.camera.fov = 70;
  return scene;
}

TEST(ReferenceRender, TheSkinOfASquareThatRunsBehindTheEyeIsWhereTheRaysMeetIt) {
  // There is no fur, and the light is ambient only. The colour of a pixel must be the coat's colour where the
  // pixel's ray meets the plane.
  Scene scene = skimming_scene();
  scene.shading.lights = {LightScene{{0, 0, 1}, 0}};
  scene.shading.ambient = 1;
  scene.shading.shadow = 2;
  scene.coat.skin = glm::vec3(1);
  for (const int cells : {1, 3}) {
    FrameInput input = synthetic::frame(scene, synthetic::square(6), cells, cells, 0);
    for (auto& level : input.fur.level)
      for (auto& texel : level) texel = {0, 128};
    // The coat's red increases linearly with u and its green with v, so bilinear lookups are exact between
    // texel centres.
    input.coat.size = 128;
    input.coat.texel.clear();
    for (int j = 0; j < 128; ++j)
      for (int i = 0; i < 128; ++i)
        input.coat.texel.push_back({std::uint8_t(2 * i), std::uint8_t(2 * j), 0, 255});
    const Picture picture = render(input, {});
    int skin = 0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const Camera& camera = input.camera;
        const glm::dvec3 ray = glm::dvec3(camera.ray) +
                               (x + .5 - camera.width * .5) * glm::dvec3(camera.ray_dx) +
                               (y + .5 - camera.height * .5) * glm::dvec3(camera.ray_dy);
        const double t = -double(camera.eye.z) / ray.z;
        const glm::dvec2 uv = (glm::dvec2(camera.eye) + t * glm::dvec2(ray)) / 6.0 + .5;
        const bool hit = t > 0 && std::min(uv.x, uv.y) > 0 && std::max(uv.x, uv.y) < 1;
        // The rounding of vertices to 1/256 pixel moves the silhouette by a fraction of a pixel, so the test
        // skips pixels near the silhouette.
        const double margin = 1e-3 * t * t;
        if (t > 0 &&
            (std::min({std::abs(uv.x), std::abs(uv.y), std::abs(1 - uv.x), std::abs(1 - uv.y)}) < margin))
          continue;
        ASSERT_EQ(picture.at(x, y).w, hit ? 1 : 0) << x << ' ' << y;
        if (!hit || std::min(uv.x, uv.y) < 1 / 128.0 || std::max(uv.x, uv.y) > 127 / 128.0) continue;
        ++skin;
        // The UV distance between adjacent pixels grows with the square of the distance from the eye.
        const double steepness = std::max(1.0, t * t);
        ASSERT_NEAR(picture.at(x, y).x, .5 * 2 * (uv.x * 128 - .5) / 255, 2e-4 * steepness) << x << ' ' << y;
        ASSERT_NEAR(picture.at(x, y).y, .5 * 2 * (uv.y * 128 - .5) / 255, 2e-4 * steepness) << x << ' ' << y;
      }
    EXPECT_GT(skin, 5000);
  }
}

TEST(ReferenceRender, ATriangleBehindTheEyeIsClippedLikeItsPieces) {
  const Scene scene = skimming_scene();
  const Picture large = render(synthetic::frame(scene, synthetic::square(6), 1, 1, 0), {});
  const Picture pieces = render(synthetic::frame(scene, synthetic::square(6), 40, 40, 0), {});
  // `large` draws the square as 2 triangles, `pieces` as 3200 triangles. The pictures are not equal bit for
  // bit. The rounding to 1/256 pixel moves the corners of the small triangles by up to 1/512 pixel, which
  // changes the barycentric coordinates.
  const Agreement agreement = compare(large, pieces);
  EXPECT_GT(agreement.pixels, 8000u);
  EXPECT_GT(agreement.psnr, 45) << agreement.worst << " at " << agreement.worst_x << ' ' << agreement.worst_y;
}

TEST(ReferenceRender, AnOpaqueCoatShowsItsOutermostLayer) {
  // Every texel has coverage 1 and shade 2/3. The camera looks from above, so only the outermost layer is
  // visible. In Eq. 6 of S, the height of this layer is h = 1, and the strand direction T and the normal nu
  // are the z axis.
  Scene scene = synthetic::upright_scene();
  scene.camera.eye = {0, 0, 4};
  scene.shading.wrap = 0;
  scene.shading.lights = {LightScene{{0, 3, 4}, 2}};
  scene.shading.ambient = .1f;
  scene.shading.specular = glm::vec3(.3f);
  scene.shading.exponent = 4;
  FrameInput input = synthetic::frame(scene, synthetic::square(2), 4, 4, 0);
  for (auto& level : input.fur.level)
    for (auto& texel : level) texel = {255, 85};
  input.coat = {1, {{204, 102, 51, 255}}};
  const Picture picture = render(input, {});
  // In Eq. 6 of paper S, L is the direction to the light. Here T.L = 4/5 and |T x L| = 3/5. In the middle of
  // the picture, the view direction E differs from -z by at most 1/600, so T.E is nearly -1 and |T x E| is
  // nearly 0. The highlight is a power of (T.L)(T.E) + |T x L||T x E|. This sum is negative, so there is no
  // highlight.
  const glm::vec4 middle = picture.at(80, 50);
  EXPECT_NEAR(middle.x, .8 * 2 / 3 * (.1 + 2 * .6), 1e-6);
  EXPECT_NEAR(middle.y, .4 * 2 / 3 * (.1 + 2 * .6), 1e-6);
  EXPECT_NEAR(middle.z, .2 * 2 / 3 * (.1 + 2 * .6), 1e-6);
  EXPECT_EQ(middle.w, 1);
  // With fur.shade 0, every strand has the coat's colour, whatever the texture stores.
  input.scene.fur.shade = 0;
  EXPECT_NEAR(render(input, {}).at(80, 50).x, .8 * (.1 + 2 * .6), 1e-6);
}

TEST(ReferenceRender, HalfTransparentLayersAddUpBackToFront) {
  // The fur is black with coverage 51/255 = .2 everywhere, and the skin is white in ambient light. The 16
  // layers let .8^16 of the skin's brightness pass.
  Scene scene = synthetic::upright_scene();
  scene.camera.eye = {0, 0, 4};
  scene.shading.ambient = 1;
  scene.shading.shadow = 1e6f;
  scene.shading.lights = {LightScene{{0, 0, 1}, 0}};
  FrameInput input = synthetic::frame(scene, synthetic::square(2), 4, 4, 0);
  for (auto& level : input.fur.level)
    for (auto& texel : level) texel = {51, 0};
  input.coat = {1, {{255, 255, 255, 255}}};
  input.scene.coat.skin = glm::vec3(1);
  EXPECT_NEAR(render(input, {}).at(80, 50).x, std::pow(.8, 16), 1e-5);
}

TEST(ReferenceRender, SkinInFrontHidesFurBehind) {
  // The surface is a folded sheet with opaque fur. Its upper half is red, and its lower half is green. In
  // each layer, the lower half is drawn after the upper half.
  const synthetic::Surface folded{[](double u, double v) {
    return u < .5 ? glm::dvec3(4 * u - 1, 2 * v - 1, .5) : glm::dvec3(3 - 4 * u, 2 * v - 1, 0);
  }};
  Scene scene = synthetic::lively_scene();
  scene.camera.eye = {0, 0, 3};
  scene.camera.up = {0, 1, 0};
  FrameInput input = synthetic::frame(scene, folded, 16, 8, 0);
  for (auto& level : input.fur.level)
    for (auto& texel : level) texel = {255, 128};
  input.coat = {32, {}};
  for (int j = 0; j < 32; ++j)
    for (int i = 0; i < 32; ++i) {
      const bool above = i < 16;
      input.coat.texel.push_back({std::uint8_t(above ? 255 : 0), std::uint8_t(above ? 0 : 255), 0, 255});
    }
  input.scene.shading.specular = glm::vec3(0);
  const Picture picture = render(input, {});
  for (int y = 35; y < 65; ++y)
    for (int x = 60; x < 85; ++x) {
      EXPECT_GT(picture.at(x, y).x, .1);
      EXPECT_EQ(picture.at(x, y).y, 0);
    }
  input.camera = synthetic::camera({false, {}, {0, 0, -3}, {0, 0, 0}, {0, 1, 0}, 37, .01f}, 160, 100);
  // From below, the camera sees the lower half of the folded sheet, which is green.
  EXPECT_GT(render(input, {}).at(80, 50).y, .1);
}

TEST(ReferenceRender, EveryMutantIsSeenAndTheOriginalIsNot) {
  const FrameInput input = *small_frame("curling");
  const Picture right = render(input, after(20));
  EXPECT_TRUE(within(compare(right, render(input, after(20)))));
  for (const reference::Mutant mutant : pictures::planted) {
    const Agreement agreement = compare(right, render(input, after(20, mutant)));
    EXPECT_FALSE(within(agreement)) << "mutant " << int(mutant) << ": " << agreement.psnr << " dB";
  }
}

TEST(ReferenceRender, RefusesInputsThatDoNotFit) {
  FrameInput input = *small_frame("curling");
  input.strands.phase.pop_back();
  EXPECT_THROW(render(input, {}), InputError);
  input = *small_frame("curling");
  input.mesh = nullptr;
  EXPECT_THROW(render(input, {}), InputError);
  input = *small_frame("curling");
  input.fur.layers = 8;
  EXPECT_THROW(render(input, {}), InputError);
}

}  // namespace
}  // namespace pelage
