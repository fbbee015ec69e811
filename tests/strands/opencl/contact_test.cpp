// Tests colliders that push single strands (docs/colliders.md): the kernels' text in double precision, and
// the device, give the reference's states.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "harness/compare/strands.hpp"
#include "harness/error.hpp"
#include "harness/strands/opencl/strands.hpp"
#include "harness/strands/reference/chain.hpp"
#include "tests/strands/support/strands.hpp"
#include "tests/support/opencl_as_cpp.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::in_double {
inline real gather(const real* table, whole i) {
  return table[i];
}
#define CONTACT 1
// clang-format off
#include "strands/chain/pushed.clh"
// clang-format on
}  // namespace pelage::in_double

namespace pelage::strands {
namespace {

using in_double::real3;

glm::dvec3 as_glm(real3 v) {
  return {v.x, v.y, v.z};
}
real3 as_real3(glm::dvec3 v) {
  return in_double::vec3(v.x, v.y, v.z);
}

/// A table of kernels/common/contact.clh with one ball.
std::vector<double> ball_table(glm::dvec3 centre, double radius, glm::dvec3 velocity) {
  std::vector<double> table{3, 2, 2, 2, 1, 0, 0, 0, centre.x, centre.y, centre.z, 0, 0, 0, 0, radius};
  table.insert(table.end(), {velocity.x, velocity.y, velocity.z, 0});
  table.resize(8 + 3 * 12);
  return table;
}

TEST(PushedStrands, KernelsAreTheReference) {
  synthetic::Any any{5};
  const double field = 0;
  int joints = 0, tips = 0;
  for (const float length : {0.001f, 0.2f, 10.0f})
    for (const float part : {0.1f, 0.5f, 0.9f})
      for (int i = 0; i < 400; ++i) {
        Chain chain;
        chain.root = glm::vec3(any.vector());
        chain.normal = glm::vec3(any.direction());
        chain.length = length;
        ChainDynamics dynamics;
        dynamics.first_segment = part;
        reference::State s;
        s.u = any.direction(), s.w = any.direction();
        const auto across = [&](glm::dvec3 v) {
          const glm::dvec3 rate = 20.0 * any.vector();
          return rate - glm::dot(rate, v) * v;
        };
        s.a = across(s.u), s.b = across(s.w);
        Scene scene;
        ContactSphereScene& ball = scene.contact.spheres.emplace_back();
        ball.centre = chain.root + 0.8f * length * glm::vec3(any.vector());
        ball.radius = 0.6f * length;
        ball.motion.velocity = 3 * length * glm::vec3(any.vector());
        const pelage::reference::Colliders colliders(scene, {}, 0);
        const reference::State exact = reference::pushed(chain, dynamics, s, colliders);
        const std::vector<double> table =
            ball_table(glm::dvec3(ball.centre), double(ball.radius), glm::dvec3(ball.motion.velocity));
        const in_double::Limbs found = in_double::pushed_limbs(
            in_double::colliders_at(table.data(), &field, 0),
            {as_real3(s.u), as_real3(s.w), as_real3(s.a), as_real3(s.b)}, as_real3(glm::dvec3(chain.root)),
            as_real3(glm::dvec3(chain.normal)), 1 / double(length), double(part), 1 - double(part));
        EXPECT_LT(glm::distance(as_glm(found.u), exact.u), 1e-9);
        EXPECT_LT(glm::distance(as_glm(found.w), exact.w), 1e-9);
        EXPECT_LT(glm::distance(as_glm(found.a), exact.a), 1e-6);
        EXPECT_LT(glm::distance(as_glm(found.b), exact.b), 1e-6);
        EXPECT_NEAR(glm::length(exact.u), 1, 1e-12);
        EXPECT_NEAR(glm::dot(exact.b, exact.w), 0, 1e-9);
        joints += glm::distance(exact.u, s.u) > 1e-3;
        tips += glm::distance(exact.w, s.w) > 1e-3;
      }
  EXPECT_GT(joints, 200);
  EXPECT_GT(tips, 200);
}

/// Strands on a torus, pressed by a ball that moves along its side.
Scene pressed_strands() {
  Scene scene;
  scene.dynamics.topology = "chains";
  StrandLayerScene& layer = scene.strands.layers.front();
  layer.count = 3000;
  layer.length = 0.4f;
  ContactSphereScene& ball = scene.contact.spheres.emplace_back();
  ball.centre = {2.53f, 0, -0.3f};  // outside the torus
  ball.radius = 1.5f;
  ball.motion.velocity = {0, 0, 1};
  return scene;
}

TEST(PushedStrands, StepLikeTheReferenceOnTheDevice) {
  const auto mesh = std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 48, 24));
  const auto input = prepare_strands(pressed_strands(), mesh);
  Strands strands(test::queue().device(), input);
  strands.advance(20);
  ChainStep step{strands.states(), {}, 0};
  step.number = strands.substep();
  step.after = strands.states();
  for (const Check& check : check_chain_step(*input, step, 1))
    EXPECT_TRUE(check.holds()) << check.metric << " is " << check.value << ", the limit is " << check.limit;
  // Strands without colliders would be elsewhere.
  Scene alone = pressed_strands();
  alone.contact = {};
  Strands free(test::queue().device(), prepare_strands(alone, mesh));
  free.advance(20);
  const std::vector<ChainState> others = free.states();
  std::size_t moved = 0;
  for (std::size_t i = 0; i < others.size(); ++i)
    moved += glm::distance(others[i].direction[1], step.before[i].direction[1]) > 0.1f;
  EXPECT_GT(moved, others.size() / 50);
}

TEST(PushedStrands, LeaveTheBall) {
  const auto mesh = std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 48, 24));
  const auto input = prepare_strands(pressed_strands(), mesh);
  Strands strands(test::queue().device(), input);
  const int frames = 20;
  strands.advance(frames);
  const std::vector<ChainState> states = strands.states();
  const ContactSphereScene& ball = input->scene.contact.spheres.front();
  const double time = double(frames) * input->scene.dynamics.substeps * double(input->scene.dynamics.step);
  const glm::dvec3 centre = ball.motion.moved(ball.centre, time);
  std::size_t reach = 0, deep = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Chain& chain = input->fur.chains[i];
    const double first = double(input->dynamics.first_segment), length = double(chain.length);
    const glm::dvec3 joint = glm::dvec3(chain.root) + length * first * glm::dvec3(states[i].direction[0]);
    const glm::dvec3 tip = joint + length * (1 - first) * glm::dvec3(states[i].direction[1]);
    if (glm::distance(glm::dvec3(chain.root), centre) < double(ball.radius)) continue;  // no way out
    const double depth =
        double(ball.radius) - std::min(glm::distance(joint, centre), glm::distance(tip, centre));
    reach +=
        glm::distance(glm::dvec3(chain.root) + length * glm::dvec3(chain.rest), centre) < double(ball.radius);
    deep += depth > 0.05 * length;
  }
  EXPECT_GT(reach, states.size() / 50);
  EXPECT_LT(deep, reach / 10);
}

TEST(PushedStrands, NeedAnObjectThatStays) {
  const auto mesh = std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 24, 12));
  Scene scene = pressed_strands();
  scene.dynamics.motion.spin = 1;
  EXPECT_THROW(prepare_strands(scene, mesh), InputError);
}

}  // namespace
}  // namespace pelage::strands
