// Compiles the kernels' functions for Eq. 3 and 4 of paper B (Banisch and Wuethrich 2006) as C++ in double
// precision. Compares their results with closed forms and with the reference. Tests the spring stage, which
// simulates the masses and computes the tips, and that every stage of a frame writes only its own buffers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "harness/cl/measure.hpp"
#include "harness/compare/frame_output.hpp"
#include "harness/error.hpp"
#include "harness/shells/opencl/raster_stage.hpp"
#include "harness/shells/opencl/simulate_stage.hpp"
#include "harness/shells/reference/layers.hpp"
#include "harness/springs/model/scene.hpp"
#include "harness/springs/opencl/mass_springs.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/rasterize_in_double.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

namespace shim = in_double;
using shim::glm_of;
using shim::shim_of;
using namespace pictures;
using reference::Mutant;

constexpr double length = 0.11;

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-12);
}

/// A unit surface normal, and the top of a stick that leans away from the normal. any_stick(i) always returns
/// the same stick for the same i.
struct Stick {
  glm::dvec3 normal, top;
};
Stick any_stick(std::uint32_t i) {
  synthetic::Any any{i};
  const glm::dvec3 n = any.direction();
  return {n, length * (n + 0.8 * any.vector())};
}

/// Returns the displacement of a layer from the skin, computed by the kernels' code. h is the height of the
/// layer, from 0 (skin) to 1.
glm::dvec3 layer(const Stick& stick, double h, double power, bool level) {
  const shim::real3 a = shim_of(length * stick.normal);
  shim::real3 b = shim::stick_tip(shim_of(stick.top), a);
  if (level) b = shim::level_tip(b, a);
  return glm_of(shim::layer_offset(shim::stick_weights(h, std::pow(h, power)), a, b, shim::vec3(0, 0, 0)));
}

TEST(EquationsOfSticks, EquationThreeAndFourAreAsPrinted) {
  for (std::uint32_t i = 0; i < 200; ++i) {
    const Stick stick = any_stick(i);
    const glm::dvec3 n = stick.normal, s = glm::normalize(stick.top);
    for (const double h : {0.0, 0.125, 0.5, 1.0}) {
      const double rise = h * length, part = h * h * length;
      expect_near(layer(stick, h, 2, false), rise * n + part * (s - n));
      expect_near(layer(stick, h, 1, false), rise * s);
      expect_near(layer(stick, h, 2, true), rise * n + part * (s - glm::dot(s, n) * n));
      // With dynamics.bend = "tangent", the bend does not change the height of a layer along the normal.
      EXPECT_NEAR(glm::dot(layer(stick, h, 3, true), n), rise, 1e-12);
    }
  }
  expect_near(glm_of(shim::stick_tip(shim::vec3(0, 0, 0), shim::vec3(0, 1, 0))), glm::dvec3(0.0));
}

TEST(EquationsOfSticks, LayersAreTheReferences) {
  DynamicsScene dynamics;
  for (const char* bend : {"linear", "paper", "tangent"})
    for (const float power : {1.5f, 2.0f, 4.0f}) {
      dynamics.bend = bend;
      dynamics.bend_power = power;
      const double k = dynamics.bend == "linear" ? 1 : double(power);
      for (std::uint32_t i = 0; i < 50; ++i) {
        const Stick stick = any_stick(i);
        const reference::Bend bent = reference::stick_bend(dynamics, length, stick.normal, stick.top);
        for (const double h : {0.0625, 0.4375, 1.0})
          expect_near(layer(stick, h, k, dynamics.bend == "tangent"),
                      reference::stick_displacement(dynamics, bent, h));
      }
    }
}

/// Returns a scene with a wind that acts on a mass at rest with a force of 0.01 newtons.
Scene windy_scene(const std::string& topology) {
  Scene scene = synthetic::lively_scene();
  scene.dynamics.topology = topology;
  scene.dynamics.drag = 0.004f;
  scene.dynamics.wind.strength = 0.01f;
  return scene;
}

FrameInput small_input(const std::string& topology) {
  // 63 surface points, not a multiple of 16
  return synthetic::frame(windy_scene(topology), synthetic::torus(), 9, 7, 0);
}

TEST(SpringStage, WindPushesAMassAtRestWithTheScenesStrength) {
  const FrameInput input = small_input("sticks");
  const springs::Dynamics d = springs::dynamics_of(input.scene.dynamics, springs::network_of(input));
  EXPECT_FLOAT_EQ(d.wind.speed * d.drag, 0.01f);
  EXPECT_EQ(d.solver, springs::Solver::semi_implicit_euler);
}

TEST(SpringStage, APokePushesTheTrianglesInReachAndNoOther) {
  FrameInput input = small_input("separable-sticks");
  input.scene.dynamics.poke = {
      .point = {0.7f, 0, 0}, .radius = 0.35f, .force = {0, 0.02f, 0}, .spread = 0.01f, .along = {0, 0, 1}};
  const springs::SpringNetwork network = springs::network_of(input);
  const auto force = springs::pushes(network, *input.mesh, input.scene.dynamics.poke);
  ASSERT_EQ(force.size(), 3 * input.mesh->triangle.size());
  std::size_t poked = 0;
  for (std::size_t f = 0; f < input.mesh->triangle.size(); ++f) {
    glm::dvec3 centre(0.0);
    for (int c = 0; c < 3; ++c) centre += glm::dvec3(input.mesh->position[input.mesh->triangle[f][c]]) / 3.0;
    const glm::dvec3 from = centre - glm::dvec3(glm::vec3(0.7f, 0, 0));
    const bool near = glm::length(from) <= double(0.35f);
    poked += near;
    const glm::dvec2 away = glm::normalize(glm::dvec2(from));
    for (std::size_t c = 0; c < 3; ++c) {
      const glm::dvec3 expected = near ? glm::dvec3(0.01 * away.x, 0.02 + 0.01 * away.y, 0) : glm::dvec3(0);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(force[3 * f + c][k], expected[k], 1e-7);
    }
  }
  EXPECT_GT(poked, 3u);
  EXPECT_LT(poked, input.mesh->triangle.size() / 2);
  input.scene.dynamics.poke.radius = 0;
  EXPECT_TRUE(springs::pushes(network, *input.mesh, input.scene.dynamics.poke).empty());
}

TEST(SpringStage, ARayPokesTheTriangleThatItMeets) {
  FrameInput input = small_input("separable-sticks");
  PokeScene& poke = input.scene.dynamics.poke;
  poke = {.point = {3, 0.1f, 0.05f}, .ray = {-2, 0, 0}, .force = {0, 0.02f, 0}};
  const springs::SpringNetwork network = springs::network_of(input);
  const auto poked = [&] {
    std::vector<std::size_t> found;
    const auto force = springs::pushes(network, *input.mesh, poke);
    for (std::size_t i = 0; i < force.size(); ++i)
      if (force[i] != glm::vec3(0)) found.push_back(i);
    return found;
  };
  // The ray runs in the direction -x on the line y = 0.1, z = 0.05, so it first meets the face that crosses
  // this line at the greatest x.
  std::size_t face = 0;
  double farthest = -1;
  for (std::size_t f = 0; f < input.mesh->triangle.size(); ++f) {
    glm::dvec3 p[3];
    for (int c = 0; c < 3; ++c) p[c] = glm::dvec3(input.mesh->position[input.mesh->triangle[f][c]]);
    const glm::dvec2 at(0.1f, 0.05f);
    const auto area = [](glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
      return std::abs((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
    };
    const glm::dvec2 q[3] = {{p[0].y, p[0].z}, {p[1].y, p[1].z}, {p[2].y, p[2].z}};
    const double whole = area(q[0], q[1], q[2]);
    const double part[3] = {area(at, q[1], q[2]), area(q[0], at, q[2]), area(q[0], q[1], at)};
    if (part[0] + part[1] + part[2] > whole * (1 + 1e-9)) continue;
    const double x = (part[0] * p[0].x + part[1] * p[1].x + part[2] * p[2].x) / whole;
    if (x > farthest) farthest = x, face = f;
  }
  ASSERT_GT(farthest, 0.5);
  EXPECT_EQ(poked(), (std::vector<std::size_t>{3 * face, 3 * face + 1, 3 * face + 2}));
  // With a radius above 0, the poke pushes the sticks around the point where the ray meets the mesh.
  poke.radius = 0.35f;
  const std::vector<std::size_t> around = poked();
  EXPECT_GT(around.size(), 3u);
  EXPECT_LT(around.size(), network.sticks() / 2);
  for (const std::size_t i : around) EXPECT_GT(network.mass[i].x, 0) << "on the side of the ray";
  poke.ray = {2, 0, 0};
  EXPECT_THROW(springs::pushes(network, *input.mesh, poke), InputError);
}

TEST(SpringStage, NothingIsDrawnFromMassesThatFlewApart) {
  FrameInput input = small_input("prisms");
  input.scene.dynamics.springs.stiffness = 1e5f;
  Shells shells = shells_of(input);
  EXPECT_THROW(shells.advance(20), springs::Diverged);
  EXPECT_THROW(shells.frame(), springs::Diverged);
}

TEST(SpringStage, AFrameWithoutItsNormalsIsRefused) {
  FrameInput input = small_input("sticks");
  input.stick_normal.clear();
  EXPECT_THROW(shells_of(input), InputError);
  EXPECT_THROW(reference::render(input, {}), InputError);
}

TEST(SpringStage, TheLaunchesOfEveryPhaseAreTimed) {
  for (const char* topology : {"sticks", "prisms"}) {
    Shells shells = shells_of(small_input(topology));
    const cl::FrameTiming timing = shells.frame();
    if (timing.phase_event_ms.empty()) {
      EXPECT_FALSE(cl::check_timer(cl::Queue(device())).real) << topology << ": no time of a real timer";
      continue;
    }
    std::map<std::string, double> sum;
    for (const cl::KernelTime& kernel : timing.kernels) {
      EXPECT_GT(kernel.ms, 0) << kernel.kernel;
      sum[kernel.phase] += kernel.ms;
    }
    for (const char* phase : {"simulate", "transform", "bin", "raster"}) {
      EXPECT_GT(sum[phase], 0) << topology << ' ' << phase;
      EXPECT_DOUBLE_EQ(timing.phase_event_ms.at(phase), sum[phase]) << topology << ' ' << phase;
    }
  }
}

/// The stages of the pipeline. The fur stands on sticks (a mass-spring topology) and moves in the wind. The
/// constructor simulates one frame with the spring stage.
struct Stages {
  FrameInput input;
  cl::Queue queue{device()};
  shells::Geometry geometry;
  shells::WetStage wet;
  shells::RasterStage raster;
  shells::SpringStage springs;

  Stages()
      : input(moved_input()),
        geometry(shells::lay_out(input, 1)),
        wet(queue, input),
        raster(queue, input, geometry, wet, {"pixel", {}}),
        springs(queue, std::make_shared<const FrameInput>(input), geometry, 1) {
    springs.frame(queue, 0, nullptr);
  }
  static FrameInput moved_input() {
    Scene scene = windy_scene("sticks");
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

TEST(TopologiesOnCopies, LookLikeTheReference) {
  FrameInput input = *frame_on("prisms");
  input.scene.dynamics.springs.vertices = "copies";
  const auto copies = std::make_shared<FrameInput>(input);
  const std::vector<glm::dvec3> sticks = sticks_of(input);
  EXPECT_EQ(sticks.size(), input.mesh->position.size());
  EXPECT_GT(sticks.size(), std::size_t(input.mesh->welded));
  EXPECT_TRUE(same(reference_of(input, sticks), drawn_by_device(copies, "tile")));
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
                         test::by_parameter);

}  // namespace
}  // namespace pelage
