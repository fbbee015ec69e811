// Tests keyframes of forces (docs/meshes.md, section Keyframes) on the device: gusts that end, a local force
// that moves and ends, and fur that returns.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "harness/compare/checks.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/shells/reference/strands.hpp"
#include "harness/springs/reference/reference.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace pictures;

constexpr float length = .1f;

std::shared_ptr<const FrameInput> forced_torus(const std::string& topology, const std::string& keyframes) {
  const Scene scene = parse_scene(
      fmt::format(
          "dynamics.springs.return_weight = 0.4\ndynamics.drag = 0.004\nfur.length = {}\nfur.comb = 0.0\nfur.layers = 4\nfur.texture = 16\nimage.width = 16\n"
          "image.height = 16\ndynamics.topology = \"{}\"\n[keyframes]\n{}",
          length, topology, keyframes),
      "s.toml");
  const auto mesh = std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 12, 8));
  return prepare(scene_at(scene, 0), mesh);
}

std::vector<glm::vec3> reference_tips(const FrameInput& input, int frames) {
  std::vector<glm::vec3> tips;
  if (has_springs(input.scene.dynamics))
    for (const glm::dvec3& q : springs::some_reference_sticks(input, frames, 1u << 20).offset)
      tips.emplace_back(q);
  else
    for (const reference::Strand& strand : reference::simulate(input, frames)) tips.emplace_back(strand.tip);
  return tips;
}

double worst(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  return tip_errors(double(length), a, b).worst;
}

std::vector<glm::vec3> tips_of(const std::shared_ptr<const FrameInput>& input, int frames) {
  Shells shells(device(), input);
  shells.advance(frames);
  return shells.tips();
}

const char* const lively =
    "\"dynamics.wind.strength\" = [[0.0, 0.0], [0.1, 0.01], [0.3, 0.0]]\n"
    "\"dynamics.wind.direction\" = [[0.0, [1, 0, 0.2]], [0.4, [-1, 0.5, 1]]]\n"
    "\"dynamics.wind.gust\" = [[0.0, 0.0], [0.4, 2.0]]\n"
    "\"dynamics.wind.wavelength\" = [[0.0, 0.5], [0.4, 3.0]]\n"
    "\"dynamics.wind.frequency\" = [[0.0, 1.0], [0.4, 5.0]]\n"
    "\"dynamics.gravity\" = [[0.0, [0, -9.81, 0]], [0.2, [0, 0, 4]]]\n";
const char* const poked =
    "\"dynamics.poke.radius\" = [[0.0, 0.5]]\n"
    "\"dynamics.poke.point\" = [[0.0, [1, 0, 0]], [0.4, [-1, 0, 0]]]\n"
    "\"dynamics.poke.force\" = [[0.0, [0, 0, 0.01]], [0.3, [0, 0, 0]]]\n";

struct Forces : testing::TestWithParam<const char*> {
  bool springs = std::string(GetParam()) != "silva";
};

TEST_P(Forces, MoveTheTipsOfTheReference) {
  const auto input = forced_torus(GetParam(), std::string(lively) + (springs ? poked : ""));
  Shells shells(device(), input);
  for (const int frames : {1, 9, 20}) {  // after 1, 10 and 30 frames
    shells.advance(frames);
    EXPECT_LT(worst(shells.tips(), reference_tips(*input, shells.frames_simulated())), 1e-3);
  }
  // The frames before the last one have other forces than the last one.
  FrameInput still = *input;
  still.scene.dynamics = dynamics_of_frame(input->scene, 29);
  still.scene.keyframes = {};
  EXPECT_GT(worst(shells.tips(), reference_tips(still, 30)), .05);
}

TEST_P(Forces, ThatStayAreThoseOfAPlainScene) {
  const auto input = forced_torus(GetParam(), "\"dynamics.wind.strength\" = [[0.0, 0.01]]\n");
  auto plain = std::make_shared<FrameInput>(*input);
  plain->scene.keyframes = {};
  EXPECT_EQ(tips_of(input, 20), tips_of(plain, 20));
}

TEST_P(Forces, LetTheFurReturnWhenTheyEnd) {
  const auto input =
      forced_torus(GetParam(), "\"dynamics.wind.strength\" = [[0.0, 0.03], [1.0, 0.03], [1.001, 0.0]]\n");
  Shells shells(device(), input);
  const std::vector<glm::vec3> rest = reference_tips(*input, 0);
  shells.advance(60);
  EXPECT_GT(worst(shells.tips(), rest), .1);
  shells.advance(300);
  EXPECT_LT(worst(shells.tips(), rest), .02);
}

TEST_P(Forces, DoNotDependOnTheFramesThatAreDrawn) {
  const auto input = forced_torus(GetParam(), std::string(lively) + (springs ? poked : ""));
  Shells all(device(), input), some(device(), input);
  for (int i = 0; i < 20; ++i) all.frame();
  for (const int skipped : {1, 2, 0, 4, 8}) {
    some.advance(skipped);
    some.frame();
  }
  EXPECT_EQ(all.tips(), some.tips());
  EXPECT_EQ(all.read().pixel, some.read().pixel);
}

INSTANTIATE_TEST_SUITE_P(Topologies, Forces,
                         testing::Values("silva", "sticks", "prisms", "separable-sticks",
                                         "separable-prisms"));

/// Returns, for each triangle, whether the poke touches it in one of the first `frames` frames.
std::vector<bool> touched(const FrameInput& input, int frames) {
  const Mesh& mesh = *input.mesh;
  std::vector<bool> is(mesh.triangle.size());
  for (int i = 0; i < frames; ++i) {
    const PokeScene poke = dynamics_of_frame(input.scene, i).poke;
    for (std::size_t face = 0; face < is.size(); ++face) {
      glm::dvec3 centre(0);
      for (int c = 0; c < 3; ++c) centre += glm::dvec3(mesh.position[mesh.triangle[face][c]]) / 3.0;
      if (glm::distance(centre, glm::dvec3(poke.point)) <= double(poke.radius)) is[face] = true;
    }
  }
  return is;
}

TEST(PokeFrames, LeaveTheBitsOfOtherTriangles) {
  // The poke begins at 0.1 s, moves across the torus, and ends at 0.5 s.
  const char* const poke =
      "\"dynamics.poke.radius\" = [[0.0, 0.0], [0.1, 0.0], [0.101, 0.3], [0.5, 0.3], [0.501, 0.0]]\n"
      "\"dynamics.poke.point\" = [[0.0, [1, 0, 0]], [0.5, [0, 0, 1]]]\n"
      "\"dynamics.poke.force\" = [[0.0, [0, 0, 0.05]]]\n"
      "\"dynamics.poke.spread\" = [[0.0, 0.1], [0.5, 0.0]]\n"
      "\"dynamics.wind.strength\" = [[0.0, 0.01]]\n";
  for (const char* topology : {"separable-sticks", "separable-prisms"})
    for (const char* solver : {"semi-implicit-euler", "backward-euler", "rk4"}) {
      const auto pushed = std::make_shared<FrameInput>(*forced_torus(topology, poke));
      pushed->scene.dynamics.solver = solver;
      const auto alone = std::make_shared<FrameInput>(*pushed);
      std::erase_if(alone->scene.keyframes.tracks,
                    [](const KeyTrack& track) { return track.key.starts_with("dynamics.poke."); });
      alone->scene.dynamics.poke = {};
      Shells a(device(), pushed), b(device(), alone);
      for (const int frames : {7, 5, 10, 20}) {  // before, with, with and after the poke
        a.advance(frames);
        b.advance(frames);
        const std::vector<bool> is = touched(*pushed, a.frames_simulated());
        const std::vector<glm::vec3> moved = a.tips(), still = b.tips();
        std::size_t different = 0;
        for (std::size_t i = 0; i < moved.size(); ++i) {
          if (!is[i / 3]) {
            ASSERT_EQ(moved[i], still[i]) << topology << solver << a.frames_simulated() << i;
          }
          different += moved[i] != still[i];
        }
        EXPECT_EQ(different > 10u, a.frames_simulated() > 7) << topology << solver << a.frames_simulated();
      }
      const auto all = std::ptrdiff_t(pushed->mesh->triangle.size());
      EXPECT_LT(std::ranges::count(touched(*pushed, 42), true), all / 2);
    }
}

}  // namespace
}  // namespace pelage
