// Tests strands whose roots follow a skin that moves and deforms (docs/strands.md, section Moving skin).
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "harness/strands/opencl/chains.hpp"
#include "tests/strands/support/meshes.hpp"
#include "tests/strands/support/strands.hpp"

namespace pelage::strands::test {
namespace {

/// Returns the skin of a rigid object after `steps` time steps.
SkinFrame rigid(const std::vector<Chain>& chains, const ChainDynamics& d, long steps) {
  const springs::Pose pose = springs::pose_at(d.motion, double(steps) * double(d.step));
  const auto world = [&](glm::vec3 v) { return springs::turned(glm::dvec3(v), pose.axis, pose.angle); };
  const glm::dvec3 turn = pose.rate * pose.axis, turn_up = pose.rate_up * pose.axis;
  SkinFrame f;
  for (const Chain& c : chains) {
    const glm::dvec3 r = world(c.root);
    f.root.emplace_back(r);
    f.velocity.emplace_back(pose.velocity + glm::cross(turn, r));
    f.acceleration.emplace_back(pose.acceleration + glm::cross(turn_up, r) +
                                glm::cross(turn, glm::cross(turn, r)));
    f.rest.emplace_back(world(c.rest));
    f.normal.emplace_back(world(c.normal));
  }
  return f;
}

// The two computations round differently, and rounding may make a stop act in only one of them, so the worst
// 1% have no limit.
TEST(ChainSkin, ARigidSkinIsARigidObject) {
  constexpr double limit = 1e-4;
  const std::vector<Chain> chains = sphere_of(1000);
  const ChainDynamics d = shaken();
  ChainDynamics still = d;
  still.motion = {};
  Chains object(queue(), chains, d), skin(queue(), chains, still);
  for (int step = 0; step < 60; ++step) {
    object.enqueue(queue(), 1);
    skin.set_skin(queue(), rigid(chains, d, step), rigid(chains, d, step + 1), 1);
    skin.enqueue(queue(), 1);
  }
  const std::vector<ChainState> a = object.states(queue()), b = skin.states(queue());
  std::vector<double> error;
  double moved = 0;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    error.push_back(double(std::max(glm::distance(a[i].direction[0], b[i].direction[0]),
                                    glm::distance(a[i].direction[1], b[i].direction[1]))));
    moved = std::max(moved, double(glm::distance(a[i].direction[1], chains[i].rest)));
  }
  std::sort(error.begin(), error.end());
  std::printf("99%% of the directions differ by less than %.1e\n", error[989]);
  EXPECT_LT(error[989], limit);
  EXPECT_GT(moved, 0.3);
}

/// A cylinder that twists: the angle of a point is twist(t) y.
struct Twist {
  static constexpr int substeps = 4;
  std::shared_ptr<Mesh> mesh = cylinder_mesh();
  Skin at_rest = weld(*mesh);
  std::vector<Chain> chains;
  ChainDynamics dynamics;
  std::vector<SkinFrame> frames;

  Twist() {
    std::vector<glm::vec3> rest;
    for (std::size_t i = 0; i < at_rest.position.size(); ++i) {
      Chain c;
      c.root = glm::vec3(at_rest.position[i]);
      c.normal = glm::vec3(at_rest.normal[i]);
      c.rest = glm::vec3(glm::normalize(at_rest.normal[i] + 0.8 * any_tangent(at_rest.normal[i])));
      c.length = 0.2f;
      c.stiffness_first = 30 + 10 * float(i % 50);
      c.stiffness_second = 0.5f * c.stiffness_first;
      chains.push_back(c);
      rest.push_back(c.rest);
    }
    SkinMotion motion(*mesh, points_of(*mesh), rest);
    for (int k = 0; k <= 60; ++k) {
      const double twist = 1.5 * std::sin(2 * std::numbers::pi * k / 30.0);
      std::vector<glm::vec3> points;
      for (const glm::dvec3& p : at_rest.position)
        points.emplace_back(springs::turned(p, {0, 1, 0}, twist * p.y));
      frames.push_back(motion.next(points, double(dynamics.step) * substeps));
    }
  }
};

TEST(ChainSkin, StepsOnATwistingCylinderAgreeWithTheReference) {
  Twist t;
  Chains strands(queue(), t.chains, t.dynamics);
  Errors errors;
  for (std::size_t frame = 0; frame + 1 < t.frames.size(); ++frame) {
    const SkinFrame &from = t.frames[frame], &to = t.frames[frame + 1];
    strands.set_skin(queue(), from, to, Twist::substeps);
    for (int i = 0; i < Twist::substeps; ++i) {
      const std::vector<ChainState> before = strands.states(queue());
      const long number = strands.steps();
      strands.enqueue(queue(), 1);
      const std::vector<ChainState> after = strands.states(queue());
      const double f = double(i + 1) / Twist::substeps;
      for (std::size_t k = 0; k < t.chains.size(); ++k) {
        const auto between = [&](const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
          return (1 - f) * glm::dvec3(a[k]) + f * glm::dvec3(b[k]);
        };
        const reference::SkinPoint at{between(from.velocity, to.velocity),
                                      between(from.acceleration, to.acceleration),
                                      between(from.rest, to.rest), between(from.normal, to.normal)};
        errors.add(t.chains[k], after[k],
                   reference::step(t.chains[k], t.dynamics, reference::in_double(before[k]), number, &at));
      }
    }
  }
  errors.expect_small();
  EXPECT_GT(double(errors.touching), 0.005 * double(errors.rate.size()));
}

TEST(ChainSkin, HasTheSameBitsForAllLanesAndLaunches) {
  Twist t;
  const auto run = [&](const ChainOptions& options, int substeps) {
    Chains strands(queue(), t.chains, t.dynamics, options);
    for (std::size_t frame = 0; frame + 1 < t.frames.size(); ++frame) {
      strands.set_skin(queue(), t.frames[frame], t.frames[frame + 1], Twist::substeps);
      for (int i = 0; i < Twist::substeps; i += substeps) strands.enqueue(queue(), substeps);
    }
    return strands.states(queue());
  };
  const std::vector<ChainState> once = run({1, 0}, 4);
  for (const auto& [options, substeps] :
       {std::pair(ChainOptions{16, 1}, 4), std::pair(ChainOptions{16, 5}, 1)}) {
    EXPECT_EQ(different(once, run(options, substeps)), 0u)
        << options.lanes << " lanes, " << substeps << " substeps";
  }
}

TEST(ChainSkin, KeyStrandsHaveTheRootsOfTheLastFrame) {
  Twist t;
  Chains strands(queue(), t.chains, t.dynamics);
  strands.set_skin(queue(), t.frames[3], t.frames[4], 4);
  strands.enqueue(queue(), 4);
  const std::vector<KeyStrand> keys = written_keys(strands, t.chains.size());
  const std::vector<ChainState> states = strands.states(queue());
  for (std::size_t i = 0; i < t.chains.size(); ++i) {
    EXPECT_EQ(keys[i].root, t.frames[4].root[i]);
    EXPECT_EQ(keys[i].normal, t.frames[4].normal[i]);
    EXPECT_EQ(keys[i].first, states[i].direction[0]);
    EXPECT_EQ(keys[i].second, states[i].direction[1]);
    EXPECT_EQ(keys[i].rest, t.frames[4].rest[i]);
  }
}

TEST(ChainSkin, WrongFramesAreRefused) {
  Twist t;
  Chains strands(queue(), t.chains, t.dynamics);
  SkinFrame wrong = t.frames[1];
  wrong.velocity.pop_back();
  EXPECT_THROW(strands.set_skin(queue(), t.frames[0], wrong, 4), InputError);
  wrong = t.frames[1];
  wrong.normal[5] = {0, 2, 0};
  EXPECT_THROW(strands.set_skin(queue(), t.frames[0], wrong, 4), InputError);
  EXPECT_THROW(strands.set_skin(queue(), t.frames[0], t.frames[1], 0), InputError);
  strands.set_skin(queue(), t.frames[0], t.frames[1], 4);
  EXPECT_THROW(strands.enqueue(queue(), 5), InputError);
  strands.enqueue(queue(), 4);
  EXPECT_THROW(strands.enqueue(queue(), 1), InputError);
  ChainDynamics moving = t.dynamics;
  moving.motion.shake = {0.1f, 0, 0};
  Chains object(queue(), t.chains, moving);
  EXPECT_THROW(object.set_skin(queue(), t.frames[0], t.frames[1], 4), InputError);
}

}  // namespace
}  // namespace pelage::strands::test
