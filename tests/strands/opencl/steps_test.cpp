// Compares single time steps of the chains on an OpenCL device with the reference in double precision. Each
// step starts from a state of the device, so that errors do not accumulate.
#include <gtest/gtest.h>

#include "harness/compare/tolerances.hpp"
#include "harness/strands/opencl/chains.hpp"
#include "harness/strands/reference/chain.hpp"
#include "tests/strands/support/step_errors.hpp"
#include "tests/strands/support/strands.hpp"

namespace pelage::strands::test {
namespace {

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
      errors.add(chains[i], after[i], reference::step(chains[i], d, reference::in_double(before[i]), number));
  }
  errors.print();
  EXPECT_LT(errors.most(errors.direction), tolerance::chain_direction);
  EXPECT_LT(errors.most(errors.rate), tolerance::chain_rate);
  EXPECT_GT(double(errors.touching), 0.02 * double(errors.rate.size()));
}

}  // namespace
}  // namespace pelage::strands::test
