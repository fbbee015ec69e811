// Compares the device's pictures of fur on mass-spring topologies with the reference's pictures. The
// reference's code for the layers was written from docs/shells.md, independently of the kernels.
// harness/springs/reference simulates the masses in double precision.
#include <gtest/gtest.h>

#include <algorithm>

#include "harness/shells/opencl/spring_stage.hpp"
#include "harness/springs/model/scene.hpp"
#include "harness/springs/reference/reference.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace pictures;
using reference::Mutant;

/// Returns a furry torus with the given mass-spring topology, and with every force that a scene can have.
std::shared_ptr<const FrameInput> frame_on(const std::string& topology, const std::string& bend = "paper") {
  Scene scene = synthetic::lively_scene();
  DynamicsScene& d = scene.dynamics;
  d.topology = topology;
  d.bend = bend;
  d.drag = 0.004f;
  d.wind.strength = 0.012f;
  d.motion.shake = {0.02f, 0.05f, 0};
  d.motion.swing = 0.2f;
  d.poke = {.point = {0.7f, 0.3f, 0.2f}, .radius = 0.4f, .force = {0.01f, 0, 0}, .spread = 0.01f};
  return std::make_shared<FrameInput>(synthetic::frame(scene, synthetic::torus(), 24, 16, 60));
}

/// Returns the top minus the base of each stick after `frames` frames, simulated in double precision.
std::vector<glm::dvec3> sticks_of(const FrameInput& input) {
  const springs::SpringNetwork topology = springs::topology_of(input);
  const springs::Dynamics dynamics = springs::dynamics_of(input.scene.dynamics, topology);
  const std::vector<glm::vec3> push = springs::pushes(topology, *input.mesh, input.scene.dynamics.poke);
  const springs::reference::System system{topology, dynamics, {push.begin(), push.end()}};
  springs::reference::State state = springs::reference::rest(topology);
  for (int i = 0; i < frames * input.scene.dynamics.substeps; ++i)
    state = springs::reference::step(system, state, i);
  return springs::reference::offsets(topology, state);
}

Picture reference_of(const FrameInput& input, const std::vector<glm::dvec3>& sticks,
                     Mutant mutant = Mutant::none) {
  reference::Options options;
  options.frames = frames;
  options.sticks = sticks;
  options.mutant = mutant;
  return reference::render(input, options);
}

struct Topologies : testing::TestWithParam<const char*> {};

TEST_P(Topologies, LookLikeTheReference) {
  const auto input = frame_on(GetParam());
  const Picture expected = reference_of(*input, sticks_of(*input));
  for (const char* mapping : {"tile", "pixel"})
    EXPECT_TRUE(same(expected, drawn_by_device(input, mapping), 5000)) << mapping;
}

TEST_P(Topologies, EveryFormOfTheBendAndEverySolver) {
  for (const char* bend : {"linear", "tangent"}) {
    const auto input = frame_on(GetParam(), bend);
    EXPECT_TRUE(same(reference_of(*input, sticks_of(*input)), drawn_by_device(input, "tile"))) << bend;
  }
  FrameInput other = *frame_on(GetParam());
  other.scene.dynamics.solver = "backward-euler";
  other.scene.dynamics.bend_power = 3.5f;
  other.scene.shading.model = "lambert";
  const auto input = std::make_shared<FrameInput>(other);
  const Picture drawn = drawn_by_device(input, "tile");
  EXPECT_TRUE(same(reference_of(*input, sticks_of(*input)), drawn));
  other.scene.shading.model = "wet";  // a picture with another shading model must differ
  EXPECT_FALSE(within(compare(reference_of(other, sticks_of(other)), drawn)));
}

TEST_P(Topologies, MistakesAreSeen) {
  const auto input = frame_on(GetParam());
  const std::vector<glm::dvec3> sticks = sticks_of(*input);
  const Picture drawn = drawn_by_device(input, "tile");
  std::vector<Mutant> planted{Mutant::sticks_straight, Mutant::layer_missing, Mutant::height_without_one};
  if (parts(input->scene)) planted.push_back(Mutant::corners_turned);
  for (const Mutant mutant : planted) {
    const Agreement agreement = compare(reference_of(*input, sticks, mutant), drawn);
    EXPECT_FALSE(within(agreement)) << int(mutant) << ": " << describe(agreement);
  }
  const Agreement still =
      compare(reference_of(*input, std::vector<glm::dvec3>(sticks.size(), {0, 1, 0})), drawn);
  EXPECT_FALSE(within(still)) << describe(still);
}

INSTANTIATE_TEST_SUITE_P(Device, Topologies,
                         testing::Values("sticks", "prisms", "separable-sticks", "separable-prisms"),
                         [](const auto& given) {
                           std::string name = given.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace pelage
