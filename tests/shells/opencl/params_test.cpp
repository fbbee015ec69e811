// Tests what the host passes to the kernels: the parameters of the rasterizer (kernels/rasterize/params.h)
// for each of the three shading models, the table of the layers, and the programs. The programs that a scene
// is expected to need must be those that Shells builds, with the build options that the kernels read.
#include "harness/shells/opencl/params.hpp"

#include <gtest/gtest.h>

#include "harness/prepare/prepare.hpp"
#include "harness/scene/shading_models.hpp"
#include "harness/shells/opencl/mapping.hpp"
#include "harness/shells/opencl/program_texts.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::shells {
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
  return raster_params(input, lay_out(input, 1));
}

TEST(RasterParameters, OfTheCurlingAndTheWetModelAreTheScenes) {
  for (const bool wet : {false, true}) {
    SCOPED_TRACE(wet);
    const RasterParams p = params_of(wet ? "wet" : "curling");
    EXPECT_EQ(p.surface_light, wet);
    EXPECT_EQ(p.specular[0], .25f);
    EXPECT_EQ(p.specular[1], .15f);
    EXPECT_EQ(p.specular[2], .08f);
    EXPECT_EQ(p.wrap, .5f);
    EXPECT_EQ(p.darkening, .3f);
    // The exponent of the wet model depends on the wetness of the fragment.
    EXPECT_EQ(p.whole_exponent, wet ? 0 : 24);
  }
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

TEST(LayerTable, HoldsThePowersOfTheBendOfSticks) {
  Scene scene;
  scene.fur.layers = 8;
  scene.dynamics.bend_power = 3;
  const std::vector<float> bent = layer_table(scene);
  scene.dynamics.bend = "linear";
  const std::vector<float> linear = layer_table(scene);
  for (std::size_t n = 0; n < 8; ++n) {
    const double h = double(1 + n) / 8;
    EXPECT_EQ(bent[n * LAYER_COLUMNS + LAYER_POWER], float(h * h * h));
    EXPECT_EQ(linear[n * LAYER_COLUMNS + LAYER_POWER], float(h));
  }
}

Scene wet_scene() {
  Scene scene;
  scene.image = {64, 48};
  scene.fur.layers = 4;
  scene.wetness.random = 40;
  return scene;
}

void expect_exact(const Scene& scene, const ShellOptions& options) {
  SCOPED_TRACE(options.mapping);
  const cl::Device device = pictures::device();
  const auto mesh = std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 40, 24));
  const Shells shells(device, prepare(scene, mesh), options);
  test::expect_same_programs(device, expected_programs(device, scene, options), shells.programs());
  test::expect_read_options(shells.programs());
}

TEST(ExpectedPrograms, AreThoseOfThePipeline) {
  for (const std::string& mapping : mappings()) {
    expect_exact(wet_scene(), {mapping, {}});
    Scene dry = wet_scene();
    dry.wetness.random = 0;
    dry.fur.density = 0.5f;
    dry.fur.substeps = 2;
    expect_exact(dry, {mapping, {{"TILE_W", 16}, {"GROUP", 2}}});
  }
}

// An axis that no kernel reads changes how often kernels are launched, or over what. No program is built
// again.
TEST(Axes, ThatNoKernelReadsBuildNothing) {
  const cl::Device device = pictures::device();
  const auto mesh = std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 40, 24));
  const auto input = prepare(wet_scene(), mesh);
  for (const std::string& mapping : mappings()) {
    const Shells plain(device, input, {mapping, {}});
    const Shells tuned(
        device, input,
        {mapping, {{"GROUP", 2}, {"REACH", 0}, {"CHUNKS", 3}, {"WET_BUCKET", 4}, {"SIMULATE_GROUP", 2}}});
    ASSERT_EQ(plain.programs().size(), tuned.programs().size());
    for (std::size_t i = 0; i < plain.programs().size(); ++i)
      EXPECT_EQ(plain.programs()[i]->get(), tuned.programs()[i]->get()) << plain.programs()[i]->file();
  }
}

}  // namespace
}  // namespace pelage::shells
