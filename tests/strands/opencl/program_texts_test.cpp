// Compares the programs that a scene is expected to need with those that its pipeline builds.
#include "harness/strands/opencl/program_texts.hpp"

#include <gtest/gtest.h>

#include "harness/strands/opencl/strands.hpp"
#include "tests/support/programs.hpp"
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

void expect_exact(const Scene& scene, const char* what) {
  SCOPED_TRACE(what);
  const cl::Device device = cl::choose_device("");
  const auto mesh = std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 40, 24));
  const Strands strands(device, prepare_strands(scene, mesh));
  pelage::test::expect_same_programs(device, expected_programs(device, scene, {}), strands.programs());
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
