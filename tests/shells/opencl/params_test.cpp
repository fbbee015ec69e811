// Tests the parameters of the rasterizer's kernels (kernels/rasterize/params.h) for each of the three shading
// models.
#include "harness/shells/opencl/params.hpp"

#include <gtest/gtest.h>

#include <string>

#include "harness/scene/shading_models.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

/// Returns the kernel parameters for a scene with the shading model `model`. In the scene, the values of
/// shading.specular, shading.wrap and shading.darkening are not 0. A model that ignores one of these values
/// has 0 in the corresponding parameter.
RasterParams params_of(const std::string& model) {
  Scene scene = synthetic::lively_scene();
  scene.shading.model = model;
  scene.shading.specular = {.25f, .15f, .08f};
  scene.shading.exponent = 24;
  scene.shading.wrap = .5f;
  scene.shading.darkening = .3f;
  scene.shading.occlusion = .7f;
  const FrameInput input = synthetic::frame(scene, synthetic::torus(), 8, 6, 0);
  return shells::raster_params(input, shells::lay_out(input, 1));
}

void expect_constants_of_the_scene(const RasterParams& p) {
  EXPECT_EQ(p.specular[0], .25f);
  EXPECT_EQ(p.specular[1], .15f);
  EXPECT_EQ(p.specular[2], .08f);
  EXPECT_EQ(p.wrap, .5f);
  EXPECT_EQ(p.darkening, .3f);
}

TEST(RasterParameters, OfTheCurlingModelAreTheScenes) {
  const RasterParams p = params_of("curling");
  EXPECT_EQ(p.surface_light, 0);
  expect_constants_of_the_scene(p);
  EXPECT_EQ(p.whole_exponent, 24) << "the exponent is equal for all fragments";
}

TEST(RasterParameters, OfTheWetModelAreTheScenesWithLightOnTheSurface) {
  const RasterParams p = params_of("wet");
  EXPECT_EQ(p.surface_light, 1);
  expect_constants_of_the_scene(p);
  EXPECT_EQ(p.whole_exponent, 0) << "the exponent depends on the wetness of the fragment";
}

TEST(RasterParameters, OfLambertsModelHaveNoHighlightNoWrapAndNoDarkening) {
  const RasterParams p = params_of("lambert");
  EXPECT_EQ(p.surface_light, 1);
  for (const float specular : p.specular) EXPECT_EQ(specular, 0.0f);
  EXPECT_EQ(p.wrap, 0.0f);
  EXPECT_EQ(p.darkening, 0.0f);
  EXPECT_EQ(p.occlusion, .7f) << "the self-shadow of the paper stays";
}

// This test fails if a shading model is added. The new model then needs a test of its parameters in this
// file.
TEST(RasterParameters, OfEveryModelAreTested) {
  EXPECT_EQ(shading_models().size(), 3u);
}

}  // namespace
}  // namespace pelage
