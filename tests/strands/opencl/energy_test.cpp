// Tests the simulation of strands as chains of two segments on an OpenCL device (docs/strands.md, section
// "Chains"). The energy must not rise, the frequency of small oscillations must be close to the exact value,
// and the results must converge to those of short time steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/compare/tolerances.hpp"
#include "harness/strands/opencl/chains.hpp"
#include "tests/strands/support/step_errors.hpp"

namespace pelage::strands::test {
namespace {

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
