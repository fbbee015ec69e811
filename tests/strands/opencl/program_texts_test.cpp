// Compares the programs that a scene is expected to need with those that its pipeline builds.
#include "harness/strands/opencl/program_texts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "harness/cl/build_ahead.hpp"
#include "harness/strands/opencl/strands.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::strands {
namespace {

Scene torus_scene() {
  Scene scene;
  scene.model = "torus";
  scene.image.width = 96;
  scene.image.height = 64;
  scene.strands.layers.front().count = 200;
  return scene;
}

/// Returns the expected programs that the pipeline does not build, and the number of programs that it builds
/// although they are not expected.
std::pair<std::vector<cl::ProgramText>, std::size_t> differences(const Scene& scene) {
  const cl::Device device = cl::choose_device("");
  const std::vector<cl::ProgramText> expected = expected_programs(device, scene, {});
  const cl::BuildAhead ahead(device, expected);
  const auto mesh = std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 40, 24));
  const Strands strands(device, prepare_strands(scene, mesh));
  const std::vector<cl::ProgramText> unused = ahead.unused();  // before take() marks all as used
  std::size_t unexpected = 0;
  for (const cl::Program* program : strands.programs()) {
    const bool known = std::any_of(expected.begin(), expected.end(), [&](const cl::ProgramText& text) {
      return cl::BuildAhead::take(device, text)->program == program->get();
    });
    unexpected += known ? 0 : 1;
  }
  return {unused, unexpected};
}

void expect_exact(const Scene& scene, const char* what) {
  SCOPED_TRACE(what);
  const auto [unused, unexpected] = differences(scene);
  for (const cl::ProgramText& text : unused) ADD_FAILURE() << "not built: " << text.file << text.options;
  EXPECT_EQ(unexpected, 0u);
}

TEST(ExpectedPrograms, AreThoseOfThePipeline) {
  expect_exact(torus_scene(), "default");
  Scene scene = torus_scene();
  scene.strands.skin = false;
  scene.strands.shadow = "none";
  scene.strands.rim = glm::vec3(0);
  scene.strands.skin_shadow = 0;
  expect_exact(scene, "a key light only");
  scene.shading.lights.push_back(scene.shading.lights.front());
  scene.strands.shadow = "linear";
  expect_exact(scene, "a fill light and the linear shadow");
  scene = torus_scene();
  scene.strands.layers.front().twist_spread = 20;
  scene.dynamics.motion.spin = 1;
  expect_exact(scene, "styled strands on an object that rotates");
  scene.image = {1680, 1050};
  scene.strands.chain.collision = "body";
  scene.dynamics.motion = {};
  expect_exact(scene, "large tiles and a body");
}

}  // namespace
}  // namespace pelage::strands
