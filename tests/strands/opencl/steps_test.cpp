// Compares single time steps of the chains on an OpenCL device with the reference in double precision.
#include <gtest/gtest.h>

#include "harness/compare/tolerances.hpp"
#include "tests/strands/support/step_errors.hpp"

namespace pelage::strands::test {
namespace {

// Rounding may make a stop (a limit of an angle, or the skin) act on a strand in only one of the two
// computations. The rates of this strand then differ. Such strands are rare, so the worst 0.1% of the errors
// have no limit.
TEST(Steps, AgreeWithTheReference) {
  const Errors errors = step_errors(sphere_of(2000), shaken());
  errors.print();
  EXPECT_LT(errors.most(errors.direction), tolerance::chain_direction);
  EXPECT_LT(errors.most(errors.rate), tolerance::chain_rate);
  EXPECT_GT(double(errors.touching), 0.02 * double(errors.rate.size()));
}

}  // namespace
}  // namespace pelage::strands::test
