// Computes the motion of every mass-spring topology with every solver and every OpenCL compiler. The motion
// must agree with the double-precision reference.
#include <gtest/gtest.h>

#include "harness/compare/tolerances.hpp"
#include "harness/springs/opencl/mass_springs.hpp"
#include "harness/springs/reference/reference.hpp"
#include "tests/portability/elsewhere.hpp"
#include "tests/springs/support/scenes.hpp"

namespace pelage::portability {
namespace {

using namespace springs;
using namespace springs::test;

constexpr int steps = 60;

std::string file_of(Kind kind, Solver solver) {
  return std::string(kind.name) + "-" + std::string(solver.name);
}

// The tests below run this test in a child process.
TEST(DISABLED_Elsewhere, Topologies) {
  const char* wanted = std::getenv("PELAGE_TEST_KIND");
  ASSERT_NE(wanted, nullptr);
  for (const Kind kind : kinds)
    for (const Solver solver : solvers) {
      if (kind.name != wanted) continue;
      MassSprings masses(queue(), build(kind, sphere(1), fur_length), lively(solver));
      masses.advance(queue(), steps);
      leave(file_of(kind, solver), masses.offsets(queue()));
    }
}

struct Topologies : testing::TestWithParam<std::tuple<Place, Kind>> {};

TEST_P(Topologies, MoveAsTheReferenceDoes) {
  const auto& [place, kind] = GetParam();
  // The source of the kernels of Kind::sticks is short, so even a slow compiler (place.slow) compiles them
  // quickly. Therefore the test skips the slow compilers only for the other topologies.
  const std::string why = obstacle(place, place.slow && kind != Kind::sticks);
  if (!why.empty()) GTEST_SKIP() << why;
  const Elsewhere elsewhere;
  ASSERT_EQ(elsewhere.run(place, "DISABLED_Elsewhere.Topologies", place.slow ? 900 : 200,
                          "PELAGE_TEST_KIND=" + std::string(kind.name)),
            "");
  double worst = 0;
  for (const Solver solver : solvers) {
    const SpringNetwork network = build(kind, sphere(1), fur_length);
    const Dynamics dynamics = lively(solver);
    const springs::reference::State rest = springs::reference::rest(network);
    const auto offsets =
        springs::reference::offsets(network, springs::reference::after({network, dynamics}, rest, 0, steps));
    EXPECT_GT(largest_difference(springs::reference::offsets(network, rest), offsets), 0.01)
        << "something moved";
    const double error = largest_difference(elsewhere.values_of<glm::vec3>(file_of(kind, solver)), offsets);
    EXPECT_LT(error, tolerance::stick_top * double(fur_length)) << file_of(kind, solver);
    worst = std::max(worst, error);
  }
  std::printf("worst %.2g of the fur's length\n", worst / double(fur_length));
}

INSTANTIATE_TEST_SUITE_P(Of, Topologies,
                         testing::Combine(testing::ValuesIn(places()), testing::ValuesIn(kinds)),
                         pelage::test::by_parameter);

}  // namespace
}  // namespace pelage::portability
