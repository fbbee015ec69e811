// Compares single time steps of the chains on an OpenCL device with the reference in double precision. Each
// step starts from a state of the device, so that errors do not accumulate.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/compare/tolerances.hpp"
#include "harness/strands/opencl/chains.hpp"
#include "harness/strands/reference/chain.hpp"
#include "tests/strands/support/strands.hpp"

namespace pelage::strands::test {
namespace {

reference::State in_double(const ChainState& s) {
  reference::State state{glm::dvec3(s.direction[0]),
                         glm::dvec3(s.direction[1]),
                         glm::dvec3(s.rate[0]),
                         glm::dvec3(s.rate[1]),
                         {}};
  for (std::size_t i = 0; i < 4; ++i) state.stop[i] = double(s.stop[i]);
  return state;
}

struct Errors {
  std::vector<double> direction, rate;
  std::size_t touching = 0;

  /// Adds the errors of one strand. The unit of a rate is the square root of k1 + g / L, which is of the
  /// order of the strand's angular frequency.
  void add(const Chain& chain, const ChainState& device, const reference::State& exact) {
    direction.push_back(std::max(glm::distance(glm::dvec3(device.direction[0]), exact.u),
                                 glm::distance(glm::dvec3(device.direction[1]), exact.w)));
    const double unit = std::sqrt(double(chain.stiffness_first) + 9.81 / double(chain.length));
    rate.push_back(std::max(glm::distance(glm::dvec3(device.rate[0]), exact.a),
                            glm::distance(glm::dvec3(device.rate[1]), exact.b)) /
                   unit);
    touching += device.stop[0] + device.stop[1] + device.stop[2] + device.stop[3] > 0;
  }
};

double quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values[std::size_t(part * double(values.size() - 1))];
}

// Rounding may make a stop (a limit of an angle, or the skin) act on a strand in only one of the two
// computations. The rates of this strand then differ. Such strands are rare, so the worst 0.1% of the errors
// have no limit.
TEST(Steps, AgreeWithTheReference) {
  const std::vector<Chain> chains = sphere_of(2000);
  const ChainDynamics d = shaken();
  Chains strands(queue(), chains, d);
  Errors errors;
  for (int look = 0; look < 20; ++look) {
    strands.enqueue(queue(), 37);
    const std::vector<ChainState> before = strands.states(queue());
    const long number = strands.steps();
    strands.enqueue(queue(), 1);
    const std::vector<ChainState> after = strands.states(queue());
    for (std::size_t i = 0; i < chains.size(); ++i)
      errors.add(chains[i], after[i], reference::step(chains[i], d, in_double(before[i]), number));
  }
  std::printf(
      "directions: 99.9%% below %.1e, all below %.1e; rates: 99.9%% below %.1e, all below %.1e; %.1f%% "
      "touching\n",
      quantile(errors.direction, 0.999), quantile(errors.direction, 1), quantile(errors.rate, 0.999),
      quantile(errors.rate, 1), 100 * double(errors.touching) / double(errors.rate.size()));
  EXPECT_LT(quantile(errors.direction, 0.999), tolerance::chain_direction);
  EXPECT_LT(quantile(errors.rate, 0.999), tolerance::chain_rate);
  EXPECT_GT(double(errors.touching), 0.02 * double(errors.rate.size()));
}

}  // namespace
}  // namespace pelage::strands::test
