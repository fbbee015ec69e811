// Tests the collision of strands with the body, a coarse signed distance field (docs/strands.md, section
// Body).
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "harness/prepare/random.hpp"
#include "harness/strands/opencl/chains.hpp"
#include "tests/strands/support/meshes.hpp"
#include "tests/strands/support/strands.hpp"

namespace pelage::strands::test {
namespace {

/// A body with a waist: radius 0.25 + 0.5 y^2, height from -0.9 to 0.9. Its skin is concave along y, so
/// strands that lie flat on the plane of their own skin are inside the body.
std::shared_ptr<Mesh> waist() {
  return tube(36, 48, [](double t) {
    const double y = 1.8 * t - 0.9, end = std::min(1.0, 20 * (0.9 - std::abs(y)));
    return glm::dvec2((0.25 + 0.5 * y * y) * std::sqrt(std::max(0.0, end)), y);
  });
}

/// Strands on the points of the waist. They lean up or down.
std::vector<Chain> strands_on(const Mesh& mesh) {
  const Skin skin = weld(mesh);
  const Random random(5, 1);
  std::vector<Chain> chains;
  for (std::size_t i = 0; i < skin.position.size(); ++i) {
    Chain c;
    if (std::abs(skin.position[i].y) > 0.7) continue;
    c.root = glm::vec3(skin.position[i]);
    c.normal = glm::vec3(skin.normal[i]);
    const glm::dvec3 n = skin.normal[i], along = tangential({0, random.uniform(i) < 0.5 ? 1 : -1, 0}, n);
    c.rest = glm::vec3(glm::normalize(n + (0.5 + 1.5 * random.uniform(i, 1)) * along));
    c.length = 0.25f + 0.3f * float(random.uniform(i, 2));
    c.stiffness_first = 20 * std::pow(50.0f, float(random.uniform(i, 3)));
    c.stiffness_second = 0.5f * c.stiffness_first;
    chains.push_back(c);
  }
  return chains;
}

struct Scene {
  std::shared_ptr<Mesh> mesh = waist();
  std::vector<Chain> chains = strands_on(*mesh);
  ChainDynamics dynamics = shaken();
  Scene() { dynamics.body = std::make_shared<const DistanceField>(distance_field(mesh, 32)); }
};

const Scene& scene() {
  static const Scene shared;
  return shared;
}

TEST(ChainBody, StepsAgreeWithTheReference) {
  const auto& [mesh, chains, d] = scene();
  const Errors errors = step_errors(chains, d);
  errors.expect_small();
  EXPECT_GT(double(errors.in_body), 0.01 * double(errors.rate.size()));
}

/// A launch leaves out the body for strands that cannot reach it during the launch. This must not change a
/// bit.
TEST(ChainBody, HasTheSameBitsForAllLanesAndLaunches) {
  const auto run = [](const ChainOptions& options, int substeps) {
    const auto& [mesh, chains, d] = scene();
    Chains strands(queue(), chains, d, options);
    for (int steps = 0; steps < 240; steps += substeps) strands.enqueue(queue(), substeps);
    return strands.states(queue());
  };
  const std::vector<ChainState> once = run({1, 0}, 1);
  std::size_t in_body = 0;
  for (const ChainState& s : once) in_body += s.body[0] + s.body[1] > 0;
  EXPECT_GT(in_body, 0u);
  for (const auto& [options, substeps] :
       {std::pair(ChainOptions{16, 1}, 1), std::pair(ChainOptions{16, 3}, 4),
        std::pair(ChainOptions{16, 0}, 24), std::pair(ChainOptions{1, 2}, 4)}) {
    EXPECT_EQ(different(once, run(options, substeps)), 0u)
        << options.lanes << " lanes, " << substeps << " substeps";
  }
}

/// The mean depth of tips in the field at the end, beyond the depth that is allowed at rest, in R.
double depth_of(const std::vector<Chain>& chains, const ChainDynamics& d, const DistanceField& field,
                const std::vector<ChainState>& states, long steps) {
  const springs::Pose pose = springs::pose_at(d.motion, double(steps) * double(d.step));
  double sum = 0;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    const glm::dvec3 root(chains[i].root), rest(chains[i].rest);
    const auto tip = [&](glm::dvec3 u, glm::dvec3 w) {
      return root +
             double(chains[i].length) * (double(d.first_segment) * u + (1 - double(d.first_segment)) * w);
    };
    const auto object = [&](glm::vec3 v) { return springs::turned(glm::dvec3(v), pose.axis, -pose.angle); };
    const double allowed = std::min(0.0, value_at(field, tip(rest, rest)));
    sum += std::max(
        0.0, allowed - value_at(field, tip(object(states[i].direction[0]), object(states[i].direction[1]))));
  }
  return sum / double(chains.size());
}

TEST(ChainBody, KeepsTipsOutAndComesToRestWithoutGainingEnergy) {
  const auto& [mesh, chains, d] = scene();
  std::array<double, 2> depth{};
  for (const bool with_body : {false, true}) {
    ChainDynamics now = d;
    if (!with_body) now.body = nullptr;
    Chains strands(queue(), chains, now);
    double sum = 0;
    for (int frame = 0; frame < 300; ++frame) {
      strands.enqueue(queue(), 4);
      if (frame % 20 == 19)
        sum += depth_of(chains, now, *d.body, strands.states(queue()), strands.steps()) / 15;
    }
    depth[std::size_t(with_body)] = sum;
    if (!with_body) continue;
    Chains calm = calmed(strands, chains, now);
    EnergyRise early, late;
    for (int step = 0; step < 2400; ++step) {
      calm.enqueue(queue(), 1);
      if (step < 480) early.look(chains, now, calm.states(queue()));
      if (step >= 2370) late.look(chains, now, calm.states(queue()));
    }
    std::printf("largest rise of energy in a step: %.1e and %.1e of k1 + m g L\n", early.largest(),
                late.largest());
    EXPECT_LE(moving_part(now, calm.states(queue())), 0.001);
    EXPECT_LT(early.largest(), tolerance::chain_energy_rise);
    EXPECT_LT(late.largest(), tolerance::chain_energy_rise);
  }
  std::printf("mean depth of tips in the field: %.1e R without the body, %.1e R with the body; cell %.3f R\n",
              depth[0], depth[1], double(d.body->cell));
  EXPECT_GT(depth[0], 1e-3);
  EXPECT_LT(depth[1], 0.1 * depth[0]);
}

TEST(ChainBody, FieldsWithoutNodesAreRefused) {
  ChainDynamics d = scene().dynamics;
  d.body = std::make_shared<const DistanceField>();
  EXPECT_THROW(Chains(queue(), scene().chains, d), InputError);
}

}  // namespace
}  // namespace pelage::strands::test
