// Tests the simulation of strands as chains of two segments on an OpenCL device (docs/strands.md, section
// "Chains"): exact lengths, stops (limits of angles and the skin), rest, and bitwise equal results.
#include "harness/strands/opencl/chains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "tests/strands/support/strands.hpp"

namespace pelage::strands::test {
namespace {

/// The rotation of the object after `steps` time steps.
struct Frame {
  glm::dvec3 axis;
  double angle;
  Frame(const ChainDynamics& d, long steps) {
    const springs::Pose pose = springs::pose_at(d.motion, double(steps) * double(d.step));
    axis = pose.axis, angle = pose.angle;
  }
  glm::dvec3 world(glm::vec3 v) const { return springs::turned(glm::dvec3(v), axis, angle); }
};

struct Worst {
  double length = 0, first = 0, second = 0, joint = 0, tip = 0;
};

void look(Worst& worst, const std::vector<Chain>& chains, const ChainDynamics& d,
          const std::vector<ChainState>& states, long steps) {
  const Frame frame(d, steps);
  const double l1 = double(d.first_segment), l2 = 1 - l1;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    const glm::dvec3 rest = frame.world(chains[i].rest), n = frame.world(chains[i].normal),
                     u(states[i].direction[0]), w(states[i].direction[1]);
    const auto cosine = [](float degrees) { return std::cos(double(degrees) * std::numbers::pi / 180); };
    worst.length = std::max({worst.length, std::abs(glm::length(u) - 1), std::abs(glm::length(w) - 1)});
    worst.first = std::max(worst.first, cosine(chains[i].limit_first) - glm::dot(u, rest));
    worst.second = std::max(worst.second, cosine(chains[i].limit_second) - glm::dot(u, w));
    worst.joint = std::max(worst.joint, -l1 * glm::dot(n, u));
    worst.tip = std::max(worst.tip, -glm::dot(n, l1 * u + l2 * w));
    if (!std::isfinite(glm::dot(u, w))) worst.length = 1e9;
  }
}

TEST(Chains, KeepTheirLengthsAndStopsAndComeToRest) {
  const std::vector<Chain> chains = sphere_of(5000);
  ChainDynamics d = shaken();
  Chains strands(queue(), chains, d);
  Worst worst;
  long touching = 0, looks = 0;
  for (int frame = 0; frame < 600; ++frame) {
    strands.enqueue(queue(), 4);
    if (frame % 10 != 9) continue;
    const std::vector<ChainState> states = strands.states(queue());
    look(worst, chains, d, states, strands.steps());
    for (const ChainState& s : states) touching += s.stop[0] + s.stop[1] + s.stop[2] + s.stop[3] > 0;
    looks += long(states.size());
  }
  EXPECT_LT(worst.length, tolerance::chain_length);
  EXPECT_LT(worst.first, tolerance::chain_stop);
  EXPECT_LT(worst.second, tolerance::chain_stop);
  EXPECT_LT(worst.joint, tolerance::chain_stop);
  EXPECT_LT(worst.tip, tolerance::chain_stop);
  EXPECT_GT(double(touching) / double(looks), 0.02);  // otherwise the stops are not tested
  std::printf("length %.1e, limits %.1e %.1e, joint %.1e, tip %.1e; %.1f%% touching\n", worst.length,
              worst.first, worst.second, worst.joint, worst.tip, 100 * double(touching) / double(looks));
  Chains calm = calmed(strands, chains, d);
  for (int frame = 0; frame < 600; ++frame) calm.enqueue(queue(), 4);
  EXPECT_LE(moving_part(d, calm.states(queue())), 0.001);
}

TEST(Chains, HaveTheSameBitsForAllLanesAndWorkItems) {
  const std::vector<Chain> chains = sphere_of(333);
  const auto run = [&](const ChainOptions& options) {
    Chains strands(queue(), chains, shaken(), options);
    for (int frame = 0; frame < 60; ++frame) strands.enqueue(queue(), 4);
    return strands.states(queue());
  };
  const std::vector<ChainState> once = run({});
  for (const ChainOptions& options :
       {ChainOptions{}, ChainOptions{16, 1}, ChainOptions{16, 5}, ChainOptions{1, 0}, ChainOptions{1, 3}}) {
    EXPECT_EQ(different(once, run(options)), 0u)
        << options.lanes << " lanes, " << options.slices_per_item << " slices";
  }
}

// The keys of a turning object are in the object's frame: at rest, and after some steps, they are the states
// rotated by the inverse of the object's rotation.
TEST(ChainKeys, AreTheStatesInTheFrameOfTheObject) {
  const std::vector<Chain> chains = sphere_of(37);
  const ChainDynamics d = shaken();
  for (const int lanes : {1, 16}) {
    ChainOptions options;
    options.lanes = lanes;
    Chains strands(queue(), chains, d, options);
    for (const int steps : {0, 25}) {
      if (steps > 0) strands.enqueue(queue(), steps);
      const std::vector<KeyStrand> keys = written_keys(strands, chains.size());
      const Frame frame(d, strands.steps());
      const std::vector<ChainState> states = strands.states(queue());
      for (std::size_t i = 0; i < chains.size(); ++i) {
        EXPECT_EQ(keys[i].root, chains[i].root);
        EXPECT_EQ(keys[i].normal, chains[i].normal);
        EXPECT_LT(glm::distance(frame.world(keys[i].first), glm::dvec3(states[i].direction[0])), 1e-6);
        EXPECT_LT(glm::distance(frame.world(keys[i].second), glm::dvec3(states[i].direction[1])), 1e-6);
        EXPECT_EQ(keys[i].rest, chains[i].rest);
      }
    }
  }
  Chains strands(queue(), chains, d);
  EXPECT_THROW(strands.write_keys(queue(), cl::Buffer<float>(queue().device(), std::size_t(37) * KEY_RECORD)),
               InputError);
}

// Rounding may make a stop (a limit of an angle, or the skin) act on a strand in only one of the two
// computations. The rates of this strand then differ. Such strands are rare, so the worst 0.1% of the errors
// have no limit.
TEST(Steps, AgreeWithTheReference) {
  const Errors errors = step_errors(sphere_of(2000), shaken());
  errors.expect_small();
  EXPECT_GT(double(errors.touching), 0.02 * double(errors.rate.size()));
}

// Tests the simulation of strands as chains of two segments on an OpenCL device (docs/strands.md, section
// "Chains"). The energy must not rise, the frequency of small oscillations must be close to the exact value,
// and the results must converge to those of short time steps.
TEST(Chains, NeverGainEnergyWithoutWindAndMotion) {
  const std::vector<Chain> chains = sphere_of(5000);
  ChainDynamics d = shaken();
  Chains strands(queue(), chains, d);
  for (int frame = 0; frame < 60; ++frame) strands.enqueue(queue(), 4);
  Chains calm = calmed(strands, chains, d);
  EnergyRise rise;
  for (int frame = 0; frame < 240; ++frame) {
    calm.enqueue(queue(), 1);
    rise.look(chains, d, calm.states(queue()));
  }
  std::printf("largest rise of energy in a step: %.1e of k1 + m g L\n", rise.largest());
  EXPECT_LT(rise.largest(), tolerance::chain_energy_rise);
}

/// Returns the lower natural frequency omega / (2 pi) in Hz of small plane oscillations about the rest
/// direction. omega^2 is the smaller root of det(K - omega^2 M) = 0, with the stiffness matrix K and the mass
/// matrix M.
double natural_frequency(const ChainDynamics& d, const Chain& chain) {
  const ChainParams p = params(d);
  const double A = double(p.inertia_first), B = double(p.inertia_second), C = double(p.inertia_both),
               k1 = double(chain.stiffness_first), k2 = double(chain.stiffness_second);
  // M = [A C; C B], K = [k1 + k2, -k2; -k2, k2]
  const double a = A * B - C * C, b = -(A * k2 + B * (k1 + k2) + 2 * C * k2), c = (k1 + k2) * k2 - k2 * k2;
  return std::sqrt((-b - std::sqrt(b * b - 4 * a * c)) / (2 * a)) / (2 * std::numbers::pi);
}

ChainDynamics undamped(float step) {
  ChainDynamics d;
  d.step = step;
  d.drag = d.damping_first = d.damping_second = 0;
  d.gravity = {0, 0, 0};
  return d;
}

TEST(Chains, SoftStrandsOscillateAtTheirNaturalFrequency) {
  Chain chain;
  chain.stiffness_first = 40;
  chain.stiffness_second = 20;
  const ChainDynamics d = undamped(1.0f / 240);
  // The strand starts with a small deflection in the shape of the mode with the lower natural frequency.
  // `ratio` is the angle of the second segment divided by the angle of the first segment.
  const double f = natural_frequency(d, chain), omega = 2 * std::numbers::pi * f;
  const ChainParams p = params(d);
  const double ratio =
      (double(p.inertia_both) * omega * omega + 20) / (20 - double(p.inertia_second) * omega * omega);
  Chains strands(queue(), {chain}, d);
  const auto lean = [](double angle) { return glm::vec3(std::sin(angle), std::cos(angle), 0); };
  strands.set(queue(), {{.direction = {lean(0.02), lean(0.02 * ratio)}, .rate = {}, .stop = {}}});
  double last = 0.02, first_crossing = 0, latest = 0;
  int crossings = 0;
  for (int i = 1; i <= 240 * 10; ++i) {
    strands.enqueue(queue(), 1);
    const double x = double(strands.states(queue())[0].direction[0].x);
    if (last > 0 && x <= 0) {
      const double at = (i - 1 + last / (last - x)) / 240;
      if (crossings++ == 0) first_crossing = at;
      latest = at;
    }
    last = x;
  }
  const double measured = (crossings - 1) / (latest - first_crossing);
  std::printf("frequency %.4f Hz, exact %.4f Hz: %+.2f%%\n", measured, f, 100 * (measured / f - 1));
  EXPECT_NEAR(measured / f, 1, tolerance::chain_frequency);
}

TEST(Chains, ConvergeWithShorterSteps) {
  Chain chain;
  chain.stiffness_first = 200;
  chain.stiffness_second = 100;
  chain.limit_first = chain.limit_second = 180;
  const auto after = [&](int per_second) {
    ChainDynamics d;
    d.step = 1.0f / float(per_second);
    d.drag = 6;
    Chains strands(queue(), {chain}, d);
    const auto lean = [](double angle) { return glm::vec3(std::sin(angle), std::cos(angle), 0); };
    strands.set(queue(), {{.direction = {lean(0.6), lean(0.9)}, .rate = {}, .stop = {}}});
    strands.enqueue(queue(), per_second / 4);
    const ChainState s = strands.states(queue())[0];
    return 0.5 * glm::dvec3(s.direction[0]) + 0.5 * glm::dvec3(s.direction[1]);
  };
  const glm::dvec3 exact = after(7680);
  double before = 0;
  for (const int per_second : {60, 120, 240, 480, 960}) {
    const double error = glm::distance(after(per_second), exact);
    std::printf("h = 1/%d s: error %.2e L%s\n", per_second, error,
                before > 0 ? (", order " + std::to_string(std::log2(before / error))).c_str() : "");
    if (before > 0) {
      EXPECT_GT(std::log2(before / error), 0.8);
    }
    before = error;
  }
}

}  // namespace
}  // namespace pelage::strands::test
