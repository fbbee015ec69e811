// Compares the programs that a scene is expected to need with those that Shells builds, and their build
// options with the macros that the kernels read.
#include "harness/shells/opencl/program_texts.hpp"

#include <gtest/gtest.h>

#include "harness/prepare/prepare.hpp"
#include "harness/shells/opencl/mapping.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::shells {
namespace {

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
