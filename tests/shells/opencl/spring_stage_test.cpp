// Tests that every stage of a frame writes only its own buffers. The spring stage computes the tips, and the
// raster stage reads them.
#include <gtest/gtest.h>

#include <algorithm>

#include "harness/compare/frame_output.hpp"
#include "harness/shells/opencl/raster_stage.hpp"
#include "harness/shells/opencl/simulate_stage.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

/// The stages of the pipeline. The fur stands on sticks (a mass-spring topology) and moves in the wind. The
/// constructor simulates one frame with the spring stage.
struct Stages {
  FrameInput input;
  cl::Queue queue{pictures::device()};
  shells::Geometry geometry;
  shells::WetStage wet;
  shells::RasterStage raster;
  shells::SpringStage springs;

  Stages()
      : input(moved_input()),
        geometry(shells::lay_out(input, 1)),
        wet(queue, input),
        raster(queue, input, geometry, wet, {"pixel", {}}),
        springs(queue, input, geometry, 1) {
    springs.frame(queue, nullptr);
  }
  static FrameInput moved_input() {
    Scene scene = synthetic::lively_scene();
    scene.dynamics.topology = "sticks";
    scene.dynamics.drag = 0.004f;
    scene.dynamics.wind.strength = 0.01f;
    scene.image.width = 64;
    scene.image.height = 48;
    return synthetic::frame(scene, synthetic::torus(), 16, 12, 10);
  }
  const cl::Buffer<float>& tips() { return springs.tips(queue, raster.params(), raster.vertex(), nullptr); }
  Picture drawn_with(const cl::Buffer<float>& tips) {
    raster.frame(queue, tips, nullptr);
    return raster.read(queue);
  }
};

TEST(SpringStageTips, ChangeNoBufferOfTheRasterStage) {
  Stages stages;
  const std::vector<float> vertex = stages.raster.vertex().read(stages.queue);
  const cl::Buffer<float>& tips = stages.tips();
  EXPECT_NE(tips.get(), stages.raster.vertex().get());
  EXPECT_TRUE(stages.raster.vertex().read(stages.queue) == vertex);
}

TEST(SpringStageTips, AreNotChangedByDrawingAndCounting) {
  Stages stages;
  const cl::Buffer<float>& tips = stages.tips();
  const std::vector<float> before = tips.read(stages.queue);
  EXPECT_GT(std::count_if(before.begin(), before.end(), [](float value) { return value != 0; }), 300);
  stages.drawn_with(tips);
  EXPECT_TRUE(tips.read(stages.queue) == before);
  EXPECT_GT(stages.raster.count(stages.queue), 0u);
  stages.raster.tally(stages.queue, 1);
  EXPECT_TRUE(tips.read(stages.queue) == before);
}

TEST(SpringStageTips, AreWhatTheRasterStageReads) {
  Stages stages;
  const cl::Buffer<float>& tips = stages.tips();
  const std::vector<float> values = tips.read(stages.queue);
  const Picture drawn = stages.drawn_with(tips);
  const std::uint64_t count = stages.raster.count(stages.queue);
  // If the raster stage reads a copy of the buffer of the tips, the picture and the number of fragments must
  // stay the same. If it reads a buffer of zeros, the picture and the number of fragments must change.
  const cl::Buffer<float> copy(stages.queue, std::span<const float>(values));
  EXPECT_TRUE(stages.drawn_with(copy).pixel == drawn.pixel);
  EXPECT_EQ(stages.raster.count(stages.queue), count);
  const std::vector<float> zeros(values.size(), 0.0f);
  const cl::Buffer<float> none(stages.queue, std::span<const float>(zeros));
  EXPECT_FALSE(stages.drawn_with(none).pixel == drawn.pixel);
  EXPECT_NE(stages.raster.count(stages.queue), count);
}

TEST(SpringStageTips, AreDrawnWithoutTheTipsOfTheRasterStage) {
  Stages stages;
  const cl::Buffer<float>& tips = stages.tips();
  const Picture drawn = stages.drawn_with(tips);
  // Without a mass-spring topology, the raster stage reads the tips of the strands from another buffer. The
  // test fills this buffer first with zeros and then with long tips in another direction. If a kernel read
  // the wrong buffer, the picture would change.
  constexpr int stride = 1 << 16;  // more than the number of strands
  for (const float value : {0.0f, 0.3f}) {
    const std::vector<float> values(std::size_t(3) * stride, value);
    const cl::Buffer<float> strands(stages.queue, std::span<const float>(values));
    stages.raster.strand_tips(stages.queue, strands, stride, nullptr);
    EXPECT_TRUE(stages.drawn_with(tips).pixel == drawn.pixel) << value;
  }
}

// Compares the device's pictures of fur on mass-spring topologies with the reference's pictures. The
// reference's code for the layers was written from docs/shells.md, independently of the kernels.
// harness/springs/reference simulates the masses in double precision.

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
  const std::vector<glm::vec3> sticks = reference_motion(input, frames).tips;
  return {sticks.begin(), sticks.end()};
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
