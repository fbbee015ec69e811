// Compares the serial loops of the strands' simulation with the double-precision reference.
#include "harness/strands/baselines/serial_chains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "harness/strands/reference/chain.hpp"
#include "tests/strands/support/strands.hpp"
#include "tests/strands/support/weak_forces.hpp"

namespace pelage::strands::test {
namespace {

constexpr int steps = 60;

// Rounding may make a stop act on a strand in only one of the two computations, so the worst 1% have no
// limit.
void expect_reference(SerialLoop loop) {
  const std::vector<Chain> chains = sphere_of(300);
  const ChainDynamics d = shaken();
  SerialChains serial(chains, d, loop);
  for (int i = 0; i < steps; i += 3) serial.advance(3);
  const std::vector<ChainState> states = serial.states();
  std::vector<double> errors;
  double moved = 0;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    reference::State state = reference::at_rest(chains[i]);
    for (long k = 0; k < steps; ++k) state = reference::step(chains[i], d, state, k);
    errors.push_back(std::max(glm::distance(glm::dvec3(states[i].direction[0]), state.u),
                              glm::distance(glm::dvec3(states[i].direction[1]), state.w)));
    moved = std::max(moved, glm::distance(glm::dvec3(chains[i].rest), state.w));
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[std::size_t(0.99 * double(errors.size() - 1))], 1e-3);
  EXPECT_GT(moved, 0.1);
}

TEST(SerialChains, ThePlainLoopIsTheReferencesStep) {
  expect_reference(plain_chain_loop);
}
TEST(SerialChains, TheFastLoopIsTheReferencesStep) {
  expect_reference(fast_chain_loop);
}

TEST(SerialChains, WeakForcesMoveThemLikeTheReference) {
  for (const WeakForce& force : weak_forces()) {
    SerialChains serial(chains_under(force), dynamics_under(force), plain_chain_loop);
    int done = 0;
    expect_reference(
        force,
        [&](int count) {
          serial.advance(count - done);
          done = count;
          std::vector<reference::State> found;
          for (const ChainState& state : serial.states()) found.push_back(reference::in_double(state));
          return found;
        },
        false);
  }
}

}  // namespace
}  // namespace pelage::strands::test
