// Tests the comparison of the device with the reference (harness/compare/strands.hpp): a time step of strands
// that touch the body, and a picture whose fur layers are not drawn in the order of their numbers.
#include <gtest/gtest.h>

#include <algorithm>

#include "harness/compare/strands.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/strands/opencl/program_texts.hpp"
#include "harness/strands/opencl/strands.hpp"
#include "harness/strands/reference/drawing.hpp"
#include "tests/strands/support/strands.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::strands {
namespace {

/// Strands on a torus that gravity presses against the body.
Scene pressed() {
  Scene scene;
  scene.dynamics.topology = "chains";
  scene.dynamics.gravity = {0, -12, 0};
  scene.strands.chain.stiffness = 20;
  scene.strands.chain.stiffness_joint = 10;
  scene.strands.chain.collision = "body";
  scene.strands.chain.body_cells = 32;
  StrandLayerScene& layer = scene.strands.layers.front();
  layer.count = 3000;
  layer.length = 0.6f;
  layer.lean = 70;
  return scene;
}

TEST(StepCheck, HoldsForStrandsThatTouchTheBody) {
  const auto mesh = std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 48, 24));
  const auto input = prepare_strands(pressed(), mesh);
  Strands strands(test::queue().device(), input);
  strands.advance(20);
  ChainStep step{strands.states(), {}, 0};
  step.number = strands.substep();
  step.after = strands.states();
  const auto touching = std::count_if(step.before.begin(), step.before.end(),
                                      [](const ChainState& s) { return s.body[0] + s.body[1] > 0; });
  EXPECT_GT(touching, std::ptrdiff_t(step.before.size() / 100));
  for (const Check& check : check_chain_step(*input, step, 1))
    EXPECT_TRUE(check.holds()) << check.metric << " is " << check.value << ", the limit is " << check.limit;
}

// The curvature folds many strands down onto the skin, some almost along the normal. Raising their tips
// magnifies the errors of their 16-bit angles far beyond the limit of the check.
TEST(FrameCheck, HoldsForTipsThatTheSkinRaises) {
  Scene scene;
  scene.image.width = 96;
  scene.image.height = 64;
  StrandLayerScene& layer = scene.strands.layers.front();
  layer.count = 20000;
  layer.lean = 50;
  layer.curvature = 130;
  layer.curvature_spread = 5;
  const auto mesh = std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 40, 24));
  const auto input = prepare_strands(scene, mesh);
  Strands strands(test::queue().device(), input);
  strands.frame();
  StrandFrame frame{strands.keys(), {}, strands.order(), strands.read()};
  frame.curves = strands.curves();
  frame.skin = strands.surface();
  std::size_t magnified = 0, ordinary = 0;
  double worst = 0;
  for (std::size_t i = 0; i < frame.curves.size(); ++i) {
    double factor = 1;
    const DrawnStrand exact =
        reference::between(frame.keys, input->fur.strands[i], input->dynamics.first_segment, &factor);
    magnified += factor > 8;
    if (factor < 4) ordinary = i;
    worst = std::max(worst, double(glm::distance(frame.curves[i].point[2], exact.point[2])));
  }
  EXPECT_GT(magnified, 100u);
  EXPECT_GT(worst, tolerance::styled_strand_point);
  const auto point_holds = [&] {
    for (const Check& check : check_strand_frame(*input, frame, 1).checks)
      if (check.metric == "strand_point") return check.holds();
    return false;
  };
  EXPECT_TRUE(point_holds());
  frame.curves[ordinary].point[2].x += 2 * float(tolerance::styled_strand_point);
  EXPECT_FALSE(point_holds()) << "a wrong tip of an ordinary strand";
}

TEST(ReferencePicture, HasTheOrderOfTheLayers) {
  Scene scene;
  scene.dynamics.topology = "chains";
  scene.image.width = 160;
  scene.image.height = 120;
  scene.strands.shadow = "none";
  scene.strands.layers.resize(2);
  scene.strands.layers[0].order_offset = 1;  // layer 0 is drawn behind layer 1
  scene.strands.layers[1].colour = {1, 0.1f, 0.1f};
  for (StrandLayerScene& layer : scene.strands.layers) layer.count = 2000;
  const auto mesh = std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 24, 12));
  const auto input = prepare_strands(scene, mesh);
  ASSERT_EQ(input->look.layers[0].rank, 1);
  ASSERT_EQ(input->look.layers[1].rank, 0);
  Strands strands(test::queue().device(), input);
  strands.frame();
  const Agreement found = compare(strands.read(), reference_strands(*input, 1).picture);
  EXPECT_TRUE(within(found)) << found.psnr << " dB, " << found.flips << " flips";
}

// Compares the programs that a scene is expected to need with those that its pipeline builds.

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
  scene.strands.layers.front().gloss = 2;
  expect_exact(scene, "a layer with a look of its own");
  scene.strands.layers.front().damping = 2;
  expect_exact(scene, "a layer with a damping of its own");
  scene.image = {1680, 1050};
  scene.strands.chain.collision = "body";
  scene.dynamics.motion = {};
  expect_exact(scene, "large tiles and a body");
}

}  // namespace
}  // namespace pelage::strands
