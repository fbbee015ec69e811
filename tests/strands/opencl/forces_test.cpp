// Tests keyframes of forces (docs/meshes.md, section Keyframes) with strands on the device.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "harness/compare/strands.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/strands/opencl/strands.hpp"
#include "tests/strands/support/device_picture.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::strands {
namespace {

std::shared_ptr<const StrandInput> forced_strands(const std::string& keyframes) {
  const Scene scene = parse_scene(
      fmt::format(
          "strands.layer = [{{ count = 300, length = 0.2 }}]\nimage.width = 16\nimage.height = 16\n[keyframes]\n{}",
          keyframes),
      "s.toml");
  return prepare_strands(scene_at(scene, 0),
                         std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 12, 8)));
}

/// Greatest distance between the tips of the strands and of the key strands `keys`, in lengths of a strand.
double worst_tip(const Strands& strands, const StrandInput& input, const std::vector<KeyStrand>& keys) {
  const std::vector<ChainState> states = strands.states();
  const float first = input.first_segment;
  double worst = 0;
  for (std::size_t i = 0; i < states.size(); ++i)
    worst = std::max(worst, double(glm::length(first * (states[i].direction[0] - keys[i].first) +
                                               (1 - first) * (states[i].direction[1] - keys[i].second))));
  return worst;
}

TEST(StrandForces, MoveTheTipsOfTheReference) {
  const auto input = forced_strands(
      "\"dynamics.wind.strength\" = [[0.0, 0.0], [0.1, 0.03], [0.3, 0.0]]\n"
      "\"dynamics.wind.direction\" = [[0.0, [1, 0, 0.2]], [0.4, [-1, 0.5, 1]]]\n"
      "\"dynamics.wind.gust\" = [[0.0, 0.0], [0.4, 2.0]]\n"
      "\"dynamics.wind.wavelength\" = [[0.0, 0.5], [0.4, 3.0]]\n"
      "\"dynamics.wind.frequency\" = [[0.0, 1.0], [0.4, 5.0]]\n"
      "\"dynamics.gravity\" = [[0.0, [0, -9.81, 0]], [0.2, [0, 0, 4]]]\n");
  Strands strands(test::queue().device(), input);
  for (const int frames : {1, 9, 20}) {  // after 1, 10 and 30 frames
    strands.advance(frames);
    EXPECT_LT(worst_tip(strands, *input, reference_keys(*input, strands.frames_simulated()).first), 1e-3);
  }
  StrandInput still = *input;
  still.dynamics = dynamics_of_frame(*input, 29);
  still.scene.keyframes = {};
  EXPECT_GT(worst_tip(strands, *input, reference_keys(still, 30).first), .05);
}

TEST(StrandForces, LetTheFurReturnWhenTheyEnd) {
  const auto input =
      forced_strands("\"dynamics.wind.strength\" = [[0.0, 0.03], [1.0, 0.03], [1.001, 0.0]]\n");
  Strands strands(test::queue().device(), input);
  strands.advance(60);
  EXPECT_GT(worst_tip(strands, *input, input->fur.keys), .1);
  strands.advance(300);
  EXPECT_LT(worst_tip(strands, *input, input->fur.keys), .02);
}

TEST(StrandForces, DoNotDependOnTheFramesThatAreDrawn) {
  const auto input = forced_strands("\"dynamics.wind.strength\" = [[0.0, 0.03], [0.2, 0.0]]\n");
  Strands all(test::queue().device(), input), some(test::queue().device(), input);
  for (int i = 0; i < 20; ++i) all.frame();
  for (const int skipped : {1, 2, 0, 4, 8}) {
    some.advance(skipped);
    some.frame();
  }
  ASSERT_EQ(all.frames_simulated(), some.frames_simulated());
  const std::vector<ChainState> a = all.states(), b = some.states();
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].direction, b[i].direction) << i;
  EXPECT_EQ(all.read().pixel, some.read().pixel);
}

}  // namespace
}  // namespace pelage::strands
