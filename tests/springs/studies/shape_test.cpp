// Compares the lean of fur at rest and in wind with the angle at which the moments are in balance. Also tests
// the gaps between the tops of the sticks at one surface point.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <regex>

#include "harness/compare/tolerances.hpp"
#include "harness/springs/opencl/mass_springs.hpp"
#include "harness/springs/reference/reference.hpp"
#include "harness/springs/studies/study.hpp"
#include "tests/springs/support/scenes.hpp"
#include "tests/support/files.hpp"

namespace pelage::springs {
namespace {

using namespace test;

// Returns the angle in degrees between the normal of a horizontal surface and a stick in equilibrium. Three
// forces on the top have a moment about the base: a horizontal force, the weight and the return force (Eq. 5
// of Banisch and Wuethrich 2006). The force of the stick's spring acts along the stick and has no moment. The
// result is the smallest angle above 0 at which the sum of the moments changes from positive to negative.
double balanced_lean(const Dynamics& d, double horizontal) {
  const double weight = double(d.mass) * glm::length(glm::dvec3(d.gravity)), w = double(d.return_weight);
  const auto moment = [&](double angle) {
    return horizontal * std::cos(angle) + weight * std::sin(angle) -
           w * (1 - std::cos(angle)) * std::sin(angle);
  };
  double low = 1e-6, high = std::numbers::pi / 2;
  EXPECT_GT(moment(low), 0);
  EXPECT_LT(moment(high), 0);
  for (int i = 0; i < 60; ++i) (moment(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  return low * 180 / std::numbers::pi;
}

Dynamics steady_wind(double newtons) {
  Dynamics d;
  d.wind = {{1, 0, 0}, float(newtons) / d.drag, 0, 1, 1};
  return d;
}

// Without a horizontal force, exactly upright fur is in an unstable equilibrium. A force of 10 uN makes it
// lean.
constexpr double draught = 1e-5, wind_of_3_m_s = 0.012;

TEST(Lean, OfUprightFurIsTheBalanceOfMoments) {
  for (const Kind& kind : kinds)
    for (const double force : {draught, wind_of_3_m_s, 0.03}) {
      const SpringNetwork network = build(kind, square(1), fur_length);
      const Dynamics d = steady_wind(force);
      MassSprings masses(queue(), network, d);
      for (int second = 0; second < 8; ++second) masses.advance(queue(), 240);
      const Shape shape = shape_of(network, masses.offsets(queue()));
      const double expected = balanced_lean(d, force);
      std::printf("%s, %g N: %.2f degrees, expected %.2f\n", kind.name.data(), force, shape.lean_median,
                  expected);
      EXPECT_NEAR(shape.lean_median, expected, 0.05) << kind << ' ' << force;
      EXPECT_NEAR(shape.lean_least, shape.lean_most, 0.05) << kind << ' ' << force;
    }
}

// The files in the list below state the angles at which the fur leans. These angles must be equal to the
// computed angles.
TEST(Lean, IsWhatTheDocumentsSay) {
  const std::string rest = fmt::format("{:.1f}", balanced_lean(Dynamics{}, draught)),
                    windy = fmt::format("{:.1f}", balanced_lean(Dynamics{}, wind_of_3_m_s));
  std::size_t sentences = 0;
  for (const char* path :
       {"docs/springs.md", "harness/springs/model/dynamics.hpp", "experiments/banisch2006-energy.toml",
        "experiments/banisch2006-longest-step.toml", "experiments/banisch2006-mesh-size.toml",
        "experiments/banisch2006-update-time.toml", "experiments/banisch2006-work-precision.toml",
        "experiments/topology-solvers.toml"}) {
    std::string text = std::regex_replace(pelage::test::text_of(fs::path(PELAGE_SOURCE_DIR) / path),
                                          std::regex("\n *(#|///?)? *"), " ");
    const std::regex sentence(
        "leans ([0-9.]+) degrees under its weight, and ([0-9.]+) degrees in a steady horizontal wind of 3 m/s");
    std::smatch found;
    ASSERT_TRUE(std::regex_search(text, found, sentence)) << path;
    EXPECT_EQ(found[1].str(), rest) << path;
    EXPECT_EQ(found[2].str(), windy) << path;
    ++sentences;
    // No other sentence may state an angle for a wind of 3 m/s.
    EXPECT_FALSE(std::regex_search(text, std::regex("3 m/s[^.]{0,60}degrees|wind of 3 m/s bends"))) << path;
  }
  EXPECT_EQ(sentences, 8u);
}

// The paper states that grass "does not flip to the wrong side of the surface" (Banisch and Wuethrich
// 2006, section 4). This is true for forces below the constant w of the return force.
TEST(Lean, OfALoadAboveTheReturnWeightCrossesTheSurface) {
  const SpringNetwork network = build(Kind::sticks, square(1), fur_length);
  for (const auto& [load, crosses] : {std::pair(0.19, false), std::pair(0.21, true)}) {
    Dynamics d = steady_wind(draught);
    d.stiffness = 100;
    d.gravity = {0, -float(load / double(d.mass)), 0};
    MassSprings masses(queue(), network, d);
    for (int second = 0; second < 8; ++second) masses.advance(queue(), 240);
    EXPECT_EQ(shape_of(network, masses.offsets(queue())).height_least < 0, crosses) << load;
  }
}

Shape after_gusts(const Kind& kind, const Mesh& mesh, Gusts gusts) {
  const SpringNetwork network = build(kind, mesh, fur_length, Vertices::points, gusts);
  MassSprings masses(queue(), network, lively(Solver::semi_implicit_euler));
  masses.advance(queue(), 120);
  return shape_of(network, masses.offsets(queue()));
}

// Several separable sticks stand at one surface point. By default, they have the same constants and the same
// gusts, so their motions are bitwise equal. If the gusts differ between triangles, they move apart.
TEST(Gap, OfSeparableSticksNeedsGustsOfTheTriangles) {
  const Mesh mesh = sphere(1);
  const Shape alike = after_gusts(Kind::separable_sticks, mesh, Gusts::sticks);
  EXPECT_EQ(alike.gap_points, mesh.position.size());
  EXPECT_EQ(alike.gap_most, 0);
  const Shape apart = after_gusts(Kind::separable_sticks, mesh, Gusts::triangles);
  EXPECT_GT(apart.gap_median, 0.02);
  EXPECT_GE(apart.gap_most, apart.gap_median);
  const Shape prisms = after_gusts(Kind::separable_prisms, mesh, Gusts::sticks);
  EXPECT_GT(prisms.gap_median, 0.02);
  // Topologies whose triangles share their sticks have no gaps, and Gusts::triangles has no effect on them.
  EXPECT_EQ(after_gusts(Kind::prisms, mesh, Gusts::triangles).gap_points, 0u);
  EXPECT_EQ(build(Kind::prisms, mesh, fur_length, Vertices::points, Gusts::triangles).gust_at,
            build(Kind::prisms, mesh, fur_length).gust_at);
}

// With Gusts::triangles, the gaps on the device must agree with those of the reference.
TEST(Gap, IsTheOneOfTheReference) {
  for (const Kind& kind : {Kind::separable_sticks, Kind::separable_prisms}) {
    const SpringNetwork network = build(kind, sphere(0), fur_length, Vertices::points, Gusts::triangles);
    const Dynamics d = lively(Solver::semi_implicit_euler);
    MassSprings masses(queue(), network, d);
    masses.advance(queue(), 120);
    const reference::State state = reference::after({network, d}, reference::rest(network), 0, 120);
    EXPECT_LT(largest_difference(masses.offsets(queue()), reference::offsets(network, state)),
              tolerance::stick_top * double(fur_length));
  }
}

// Two sticks stand at one surface point, and their tops are 0.02 apart. Three sticks stand at another
// surface point.
TEST(Gap, IsTheLargestDistanceOfTwoTopsAtAPoint) {
  SpringNetwork network;
  network.length = 0.1f;
  network.normal.assign(5, {0, 1, 0});
  network.point = {0, 0, 7, 7, 7};
  const Shape shape =
      shape_of(network, {{0, 0.1f, 0}, {0.02f, 0.1f, 0}, {0, 0.1f, 0}, {0, 0.1f, 0.01f}, {0, 0.1f, -0.03f}});
  EXPECT_EQ(shape.gap_points, 2u);
  EXPECT_NEAR(shape.gap_most, 0.4, 1e-6);
  EXPECT_NEAR(shape.gap_median, 0.3, 1e-6);
  EXPECT_NEAR(shape.height_least, 1, 1e-6);
  EXPECT_NEAR(shape.lean_least, 0, 1e-4);
}

}  // namespace
}  // namespace pelage::springs
