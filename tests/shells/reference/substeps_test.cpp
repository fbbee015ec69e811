// Tests fragments that take several samples (docs/shells.md, section 6, "Sub-steps"): the positions of the
// samples, and their combination to one sample. Also compares texture lookups with values that are known from
// the texels.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "harness/error.hpp"
#include "harness/shells/reference/reference.hpp"
#include "harness/shells/reference/textures.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace reference;

TEST(ReferenceSubsteps, TheShiftLeadsAlongTheSurfaceToTheStrandThatTheRayMeetsBelow) {
  synthetic::Any random{7};
  int steep = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 step = random.vector(), normal = random.direction(), eye = random.direction();
    if (std::abs(glm::dot(eye, normal)) < .25) continue;
    ++steep;
    const glm::dvec3 shift = root_shift(step, normal, eye);
    EXPECT_NEAR(glm::dot(shift, normal), 0, 1e-14);
    // The view ray meets one strand at the fragment and a second strand on the layer below. The root of the
    // second strand is at `shift` relative to the root of the first. `step` is the vector along a strand from
    // the layer below to the fragment's layer. The second strand therefore meets the layer below at `shift -
    // step`, relative to the fragment. This point must be on the view ray.
    EXPECT_LT(glm::length(glm::cross(shift - step, eye)), 1e-14);
  }
  EXPECT_GT(steep, 1000);
}

TEST(ReferenceSubsteps, ARayHasNoDirectionToTheShift) {
  synthetic::Any random{7};
  // root_shift() must return the same vector for a ray direction and for the opposite direction.
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 step = random.vector(), normal = random.direction(), eye = random.direction();
    EXPECT_LT(glm::length(root_shift(step, normal, eye) - root_shift(step, normal, -eye)), 1e-14);
  }
  const glm::dvec3 up(0, 0, 1), from_above(.6, 0, -.8), from_below(.6, 0, .8);
  EXPECT_LT(glm::length(root_shift(up, up, from_above) - glm::dvec3(.75, 0, 0)), 1e-15);
  EXPECT_LT(glm::length(root_shift(up, up, from_below) - glm::dvec3(-.75, 0, 0)), 1e-15);
}

TEST(ReferenceSubsteps, UprightFurSeenHeadOnDoesNotShift) {
  synthetic::Any random{7};
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 normal = random.direction();
    EXPECT_LT(glm::length(root_shift(.3 * normal, normal, -normal)), 1e-15);
    EXPECT_LT(glm::length(root_shift(.3 * normal, normal, normal)), 1e-15);
  }
}

TEST(ReferenceSubsteps, FurSeenAlongItsStrandsDoesNotShift) {
  const glm::dvec3 normal(0, 0, 1), along = glm::normalize(glm::dvec3(.5, -.3, 1));
  EXPECT_LT(glm::length(root_shift(.2 * along, normal, -along)), 1e-15);
}

TEST(ReferenceSubsteps, GrazingRaysStayWithinFourSteps) {
  const glm::dvec3 up(0, 0, 1);
  for (const double z : {-.2499, -.1, -1e-9, 0.0, 1e-9, .1, .2499}) {
    const glm::dvec3 eye(std::sqrt(1 - z * z), 0, z), shift = root_shift(up, up, eye);
    EXPECT_LE(std::abs(shift.x), 4) << z;
    EXPECT_LT(std::abs(shift.x + (z < 0 ? -4 : 4) * eye.x), 1e-14) << z;
  }
  // If the dot product of view direction and normal is between -.25 and .25, root_shift() uses -.25 or .25
  // instead. The shift must be continuous at these two values.
  const auto tilted = [](double z) { return glm::dvec3(std::sqrt(1 - z * z), 0, z); };
  EXPECT_LT(glm::length(root_shift(up, up, tilted(-.2499999)) - root_shift(up, up, tilted(-.2500001))), 1e-5);
}

TEST(ReferenceSubsteps, SharesOfTheTangentsGoThereAndBack) {
  synthetic::Any random{7};
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 t = random.vector(), b = random.vector(), n = glm::cross(t, b);
    if (glm::length(n) < .1 * glm::length(t) * glm::length(b)) continue;
    const glm::dvec2 uv(random(), random());
    const glm::dvec3 delta = uv.x * t + uv.y * b;
    EXPECT_LT(glm::length(uv_shares(delta, t, b) - uv), 1e-12);
    EXPECT_LT(glm::length(uv_shares(delta + random() * n, t, b) - uv), 1e-11);  // off the plane
  }
}

TEST(ReferenceSubsteps, DegenerateTangentsHaveNoShares) {
  const glm::dvec3 t(1, 2, 3), delta(1, -1, .5), none(0);
  EXPECT_EQ(uv_shares(delta, t, none), glm::dvec2(0));
  EXPECT_EQ(uv_shares(delta, none, t), glm::dvec2(0));
  EXPECT_EQ(uv_shares(delta, none, none), glm::dvec2(0));
  EXPECT_EQ(uv_shares(delta, t, -2.0 * t), glm::dvec2(0));
  const glm::dvec3 x(1, 0, 0);
  EXPECT_EQ(uv_shares(delta, x, glm::dvec3(1, .0009, 0)), glm::dvec2(0));  // sin^2 = 8.1e-7
  EXPECT_NE(uv_shares(delta, x, glm::dvec3(1, .0011, 0)), glm::dvec2(0));  // sin^2 = 1.21e-6
}

TEST(ReferenceSubsteps, EqualSamplesAreOneSample) {
  for (const std::size_t count : {1u, 2u, 4u, 8u})
    for (const double coverage : {0.001, .3, .75, 1.0}) {
      const FurSample all = combined(std::vector<FurSample>(count, {coverage, 1.3}));
      EXPECT_NEAR(all.coverage, coverage, 1e-14);
      EXPECT_NEAR(all.shade, 1.3, 1e-14);
    }
}

TEST(ReferenceSubsteps, OneSolidSampleIsSolidAndNoneIsNothing) {
  EXPECT_EQ(combined({{0, 1}, {1, .5}, {0, 1}, {.5, 1}}).coverage, 1);
  EXPECT_EQ(combined({{0, 1}, {0, 2}}).coverage, 0);
  EXPECT_EQ(combined({{0, 1}, {0, 2}}).shade, 0);
}

TEST(ReferenceSubsteps, TransmittancesHaveTheirGeometricMeanAndShadesTheirMeanByCoverage) {
  const FurSample two = combined({{.36, 1.0}, {.75, .4}});
  EXPECT_NEAR(two.coverage, 1 - std::sqrt(.64 * .25), 1e-15);
  EXPECT_NEAR(two.shade, (.36 * 1.0 + .75 * .4) / 1.11, 1e-15);
  EXPECT_NEAR(combined({{0, 2}, {.2, .7}}).shade, .7, 1e-15);  // a sample of coverage 0 has no weight
}

/// Returns a skewed sheet with black fur over white skin. All slices of the fur texture have the same
/// pattern. The skin has the brightness 1, and the fur adds no light. The brightness of a pixel is therefore
/// the product of the transmittances of all layers.
FrameInput sheet(const Scene& scene) {
  const synthetic::Surface skewed{
      [](double u, double v) { return glm::dvec3(3 * (u - .5) + .8 * (v - .5), 2.6 * (v - .5), 0.0); }};
  FrameInput input = synthetic::frame(scene, skewed, 6, 6, 0);
  input.fur_scale = {3, 2};
  const int side = 8;
  input.fur = {side, scene.fur.layers, {{}}};
  for (int n = 0; n < scene.fur.layers; ++n)
    for (std::uint32_t i = 0; i < std::uint32_t(side * side); ++i)
      input.fur.level[0].push_back({std::uint8_t(60 * synthetic::noise(i, 0, 5)), 0});
  input.coat = {1, {{255, 255, 255, 255}}};
  return input;
}

Scene sheet_scene(int layers, int substeps) {
  Scene scene = synthetic::upright_scene();
  scene.fur.layers = layers;
  scene.fur.substeps = substeps;
  scene.fur.layer_spacing = "uniform";
  scene.fur.length = .3f;
  scene.curl.turns = 0;
  scene.coat.skin = glm::vec3(1);
  scene.shading.ambient = 1;
  scene.shading.shadow = 1e6f;
  scene.shading.lights = {LightScene{{0, 0, 1}, 0}};
  return scene;
}

/// Returns the greatest difference in transmittance between a picture with 16 layers and a picture with 4
/// layers, in the middle of the pictures. The picture with 16 layers has four layers for each layer of the
/// picture with 4 layers. The function therefore raises the transmittance of the picture with 4 layers to the
/// power 4.
double difference(const Picture& sixteen, const Picture& four) {
  double worst = 0;
  for (int y = 35; y < 65; ++y)
    for (int x = 60; x < 100; ++x)
      worst = std::max(worst, std::abs(double(sixteen.at(x, y).x) - std::pow(double(four.at(x, y).x), 4)));
  return worst;
}

TEST(ReferenceSubsteps, FourLooksIntoFourLayersSeeWhatSixteenLayersSee) {
  // The surface is a plane and the strands are straight. A curl with the radius `lean` and without turns
  // tilts the strands to one side. Along each view ray, 16 layers sample the fur texture at the same
  // positions as 4 layers with 4 samples each. Only the rounding of the triangles' corners to 1/256 pixel
  // differs.
  const auto drawn = [](int layers, int substeps, float lean, const glm::vec3& eye) {
    Scene scene = sheet_scene(layers, substeps);
    scene.curl.radius = lean;
    scene.camera.eye = eye;
    return render(sheet(scene), {});
  };
  for (const auto& [lean, eye] : {std::pair{0.f, glm::vec3(1.1f, 1.5f, 2)},
                                  {.4f, glm::vec3(1.1f, 1.5f, 2)},
                                  {.4f, glm::vec3(0, .1f, 2.6f)}}) {
    const Picture sixteen = drawn(16, 1, lean, eye);
    EXPECT_LT(difference(sixteen, drawn(4, 4, lean, eye)), 2e-3) << lean << ' ' << eye.x;
    EXPECT_GT(difference(sixteen, drawn(4, 1, lean, eye)), .05) << lean << ' ' << eye.x;
  }
}

TEST(ReferenceSubsteps, FourLooksFollowAClumpAsSixteenLayersDo) {
  // The fur is upright and in one clump, and a distant camera looks at the fur along the surface normal. Only
  // the clump therefore shifts the texture coordinates. This shift is linear in the height of a layer.
  const auto drawn = [](int layers, int substeps) {
    Scene scene = sheet_scene(layers, substeps);
    scene.clump.shape = 0;
    scene.clump.scale = "literal";
    scene.clump.gain = .35f;
    scene.camera.eye = {0, 0, 60};
    scene.camera.up = {0, 1, 0};
    scene.camera.fov = 2.2f;
    FrameInput input = sheet(scene);
    input.droplets = {{{.5f, .5f}, 2, .8f, {0, 0, 0}, 100}};
    return render(input, {});
  };
  const Picture sixteen = drawn(16, 1);
  EXPECT_LT(difference(sixteen, drawn(4, 4)), 2e-3);
  EXPECT_GT(difference(sixteen, drawn(4, 1)), .02);
}

TEST(ReferenceSubsteps, ALookIntoEvenFurIsAnyLook) {
  Scene scene = synthetic::lively_scene();
  const auto drawn = [&](int substeps) {
    scene.fur.substeps = substeps;
    FrameInput input = synthetic::frame(scene, synthetic::torus(), 24, 16, 20);
    for (auto& level : input.fur.level)
      for (auto& texel : level) texel = {90, 140};
    return render(input, {});
  };
  const Picture once = drawn(1), often = drawn(8);
  for (std::size_t i = 0; i < once.pixel.size(); ++i)
    for (int c = 0; c < 4; ++c) ASSERT_NEAR(once.pixel[i][c], often.pixel[i][c], 1e-6);
}

TEST(ReferenceSubsteps, NoLookAtAllIsRefused) {
  Scene scene = synthetic::lively_scene();
  scene.fur.substeps = 0;
  EXPECT_THROW(render(synthetic::frame(scene, synthetic::torus(), 12, 8, 1), {}), InputError);
}

FurTexture two_levels() {
  FurTexture fur{2, 2, {}};
  fur.level.push_back({{0, 51}, {255, 102}, {51, 153}, {102, 204}, {1, 1}, {2, 2}, {3, 3}, {4, 4}});
  fur.level.push_back({{100, 128}, {200, 10}});
  return fur;
}

TEST(ReferenceTextures, TexelCentresReturnTheirTexel) {
  const FurTexture fur = two_levels();
  EXPECT_NEAR(sample_fur(fur, {.75, .25}, 0, 0, 1).coverage, 1, 1e-12);
  EXPECT_NEAR(sample_fur(fur, {.75, .25}, 0, 0, 1).shade, 102 / 127.5, 1e-12);
  EXPECT_NEAR(sample_fur(fur, {.25, .75}, 0, 0, 1).coverage, 51 / 255.0, 1e-12);  // rows increase with v
  EXPECT_NEAR(sample_fur(fur, {.75, .75}, 1, 0, 1).coverage, 4 / 255.0,
              1e-12);                                                       // no filtering between slices
  EXPECT_NEAR(sample_fur(fur, {3.75, -1.75}, 0, 0, 1).coverage, 1, 1e-12);  // the texture repeats
}

TEST(ReferenceTextures, BetweenThemTheyAreBilinearAcrossTheBorderToo) {
  const FurTexture fur = two_levels();
  EXPECT_NEAR(sample_fur(fur, {.5, .5}, 0, 0, 1).coverage, (0 + 255 + 51 + 102) / 4.0 / 255.0, 1e-12);
  EXPECT_NEAR(sample_fur(fur, {0, .25}, 0, 0, 1).coverage, .5, 1e-12);
  EXPECT_NEAR(sample_fur(fur, {.375, .25}, 0, 0, 1).coverage, .25, 1e-12);
}

TEST(ReferenceTextures, LevelsBlendLinearlyAndAreClamped) {
  const FurTexture fur = two_levels();
  EXPECT_NEAR(sample_fur(fur, {.75, .25}, 0, 1, 1).coverage, 100 / 255.0, 1e-12);
  EXPECT_NEAR(sample_fur(fur, {.75, .25}, 0, .25, 1).coverage, (.75 * 255 + .25 * 100) / 255, 1e-12);
  EXPECT_NEAR(sample_fur(fur, {.75, .25}, 0, -3, 1).coverage, 1, 1e-12);
  EXPECT_NEAR(sample_fur(fur, {.75, .25}, 1, 9, 1).coverage, 200 / 255.0, 1e-12);
}

// Two layers of the corrected coverage are as opaque as one layer of the coverage.
TEST(ReferenceTextures, CoverageIsCorrectedAfterTheLookup) {
  const FurTexture fur = two_levels();
  const FurSample whole = sample_fur(fur, {.375, .25}, 0, 0, 1),
                  half = sample_fur(fur, {.375, .25}, 0, 0, .5);
  EXPECT_NEAR((1 - half.coverage) * (1 - half.coverage), 1 - whole.coverage, 1e-12);
  EXPECT_EQ(half.shade, whole.shade);
  EXPECT_EQ(sample_fur(fur, {.75, .25}, 0, 0, .5).coverage, 1);
}

TEST(ReferenceTextures, TheCoatIsBilinear) {
  const CoatTexture coat{2, {{255, 0, 51, 9}, {0, 0, 102, 9}, {255, 255, 0, 9}, {0, 255, 0, 9}}};
  const glm::dvec3 texel = sample_coat(coat, {.25, .25}), middle = sample_coat(coat, {1.5, .5});
  EXPECT_NEAR(texel.x, 1, 1e-12);
  EXPECT_NEAR(texel.z, .2, 1e-12);
  EXPECT_NEAR(middle.x, .5, 1e-12);
  EXPECT_NEAR(middle.y, .5, 1e-12);
  EXPECT_NEAR(middle.z, .15, 1e-12);
}

}  // namespace
}  // namespace pelage
