// Tests the check of a time step (harness/compare/strands.hpp) on strands that touch the body.
#include <gtest/gtest.h>

#include <algorithm>

#include "harness/compare/strands.hpp"
#include "harness/strands/opencl/strands.hpp"
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
  Strands strands(cl::choose_device(""), input);
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

}  // namespace
}  // namespace pelage::strands
