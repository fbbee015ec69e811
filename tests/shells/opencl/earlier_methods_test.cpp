// Tests the methods that B (Banisch and Wuethrich 2006) compares its own with: bending by trigonometric
// functions, and wind vectors (docs/springs.md, section "Earlier methods").
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/compare/frame_output.hpp"
#include "harness/error.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/shells/reference/layers.hpp"
#include "harness/springs/opencl/mass_springs.hpp"
#include "harness/springs/reference/reference.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/springs/support/scenes.hpp"
#include "tests/support/rasterize_in_double.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

namespace shim = in_double;
using shim::shim_of;
using namespace pictures;
using springs::Dynamics;
using springs::Kind;
using springs::Solver;

constexpr double hair = 0.11;

TEST(EarlierMethods, ArcsKeepTheDistanceFromTheBaseAndDivideTheAngle) {
  for (std::uint32_t i = 0; i < 200; ++i) {
    synthetic::Any any{i};
    const glm::dvec3 n = any.direction(), s = any.direction();
    if (glm::dot(n, s) < -.9) continue;
    for (const double h : {0.0625, 0.4375, 1.0}) {
      const shim::real3 found = shim::arc_offset(h, shim_of(hair * n), shim_of(hair * s));
      const glm::dvec3 p = shim::glm_of(found);
      EXPECT_NEAR(glm::length(p), h * hair, 1e-12);
      EXPECT_NEAR(std::acos(glm::dot(glm::normalize(p), n)), h * std::acos(glm::dot(n, s)), 1e-7);
      EXPECT_NEAR(glm::dot(glm::cross(n, s), p), 0, 1e-12);
      DynamicsScene dynamics;
      dynamics.bend = "trigonometric";
      const glm::dvec3 expected = reference::stick_displacement(dynamics, {hair * n, hair * s}, h);
      EXPECT_LT(glm::distance(p, expected), 1e-12);
    }
  }
  const shim::real3 upright = shim::arc_offset(.25, shim_of({0, hair, 0}), shim_of({0, hair, 0}));
  EXPECT_NEAR(upright.y, .25 * hair, 1e-15);
}

Scene leaning_scene(const std::string& bend) {
  Scene scene = synthetic::lively_scene();
  scene.shading.model = "lambert";
  scene.dynamics.topology = "sticks";
  scene.dynamics.bend = bend;
  scene.dynamics.drag = 0.004f;
  scene.dynamics.wind.strength = 0.02f;
  return scene;
}

Picture of_reference(const FrameInput& input) {
  const std::vector<glm::vec3> tips = reference_motion(input, frames).tips;
  reference::Options options;
  options.frames = frames;
  options.sticks = {tips.begin(), tips.end()};
  return reference::render(input, options);
}

TEST(EarlierMethods, ArcsLookLikeTheReference) {
  const auto input = std::make_shared<FrameInput>(
      synthetic::frame(leaning_scene("trigonometric"), synthetic::torus(), 24, 16, 60));
  for (const char* mapping : {"tile", "pixel"})
    EXPECT_TRUE(same(of_reference(*input), drawn_by_device(input, mapping), 5000)) << mapping;
  FrameInput power = *input;
  power.scene.dynamics.bend = "paper";
  EXPECT_FALSE(within(compare(of_reference(power), drawn_by_device(input, "tile"))));
}

TEST(EarlierMethods, ArcsNeedLambertsLight) {
  Scene scene = leaning_scene("trigonometric");
  EXPECT_NO_THROW(check_scene(scene));
  scene.shading.model = "curling";
  EXPECT_THROW(check_scene(scene), InputError);
}

TEST(EarlierMethods, WindVectorsAreTheReferences) {
  for (const Kind kind : {Kind::sticks, Kind::separable_sticks}) {
    const springs::SpringNetwork network =
        springs::build(kind, springs::test::sphere(1), springs::test::fur_length);
    const Dynamics dynamics = springs::test::lively(Solver::wind_vectors);
    const springs::reference::System system{network, dynamics};
    for (const int steps : {1, 7, 200}) {
      springs::MassSprings device(springs::test::queue(), network, dynamics);
      device.advance(springs::test::queue(), steps);
      const auto expected = springs::reference::offsets(
          network, springs::reference::after(system, springs::reference::rest(network), 0, steps));
      EXPECT_LT(springs::test::largest_difference(device.offsets(springs::test::queue()), expected),
                1e-5 * double(springs::test::fur_length));
    }
  }
}

// Under a constant force F the vector becomes F, and the stick the direction of w n + F. When the force ends,
// each step halves the vector.
TEST(EarlierMethods, WindVectorsLeanBySteadyForcesAndFadeByHalves) {
  const springs::SpringNetwork network =
      springs::build(Kind::sticks, springs::test::square(1), springs::test::fur_length);
  Dynamics dynamics = springs::test::still(Solver::wind_vectors);
  const float w = dynamics.return_weight;
  springs::MassSprings device(springs::test::queue(), network, dynamics);
  const std::vector<glm::vec3> force(network.sticks(), {.05f, 0, 0});
  device.push(springs::test::queue(), force);
  device.advance(springs::test::queue(), 60);
  for (const glm::vec3& q : device.offsets(springs::test::queue())) {
    EXPECT_NEAR(q.x / q.y, .05f / w, 1e-5);
    EXPECT_NEAR(glm::length(q), springs::test::fur_length, 1e-7);
  }
  device.push(springs::test::queue(), std::vector<glm::vec3>(network.sticks(), glm::vec3(0)));
  for (const float part : {.5f, .25f, .125f}) {
    device.advance(springs::test::queue(), 1);
    EXPECT_NEAR(device.offsets(springs::test::queue())[0].x / device.offsets(springs::test::queue())[0].y,
                part * .05f / w, 1e-5);
  }
}

TEST(EarlierMethods, WindVectorsNeedSticksWithoutSpringsBetweenTops) {
  Scene scene = leaning_scene("paper");
  scene.dynamics.solver = "wind-vectors";
  EXPECT_NO_THROW(check_scene(scene));
  scene.dynamics.topology = "prisms";
  EXPECT_THROW(check_scene(scene), InputError);
}

}  // namespace
}  // namespace pelage
