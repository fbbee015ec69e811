// Tests the numbers of sections against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/diagrams/diagrams.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using diagrams::Section;

double value(const Section& section, const std::vector<double>& row, const std::string& column) {
  const auto at = std::find(section.columns.begin(), section.columns.end(), column);
  EXPECT_NE(at, section.columns.end()) << column;
  return row[std::size_t(at - section.columns.begin())];
}

constexpr double exact = 1e-12;       // for values that are computed in double precision
constexpr double from_floats = 1e-6;  // for values that contain single-precision scene keys

TEST(ShapeSection, IsTheFactorOfEquationFive) {
  Scene scene;
  scene.fur.layers = 8;
  const Section section = diagrams::shape_section(scene);
  ASSERT_EQ(section.rows.size(), 5u * 8u);
  for (const auto& row : section.rows) {
    const double w = value(section, row, "w"), h = value(section, row, "h");
    EXPECT_NEAR(value(section, row, "f"), (1 - w) * h + w * (1 + std::log(h) / std::log(8.0)), exact);
  }
  EXPECT_NEAR(value(section, section.rows.front(), "h"), 1.0 / 8, exact);
  EXPECT_NEAR(value(section, section.rows.back(), "f"), 1.0, exact);
}

Scene clumped(const std::string& scale, float shape) {
  Scene scene;
  scene.fur.layers = 4;
  scene.fur.length = 0.2f;
  scene.fur.layer_spacing = "uniform";
  scene.wetness.radius = 0.05f;
  scene.wetness.wetness = 0.8f;
  scene.clump.scale = scale;
  scene.clump.shape = shape;
  return scene;
}

TEST(ClumpSection, AllStrandsOfAClumpConverge) {
  for (const float shape : {0.0f, 1.0f}) {
    const Section section = diagrams::clump_section(clumped("converge", shape), 3.0);
    for (const auto& row : section.rows) {
      const double root = value(section, row, "root"), f = value(section, row, "f");
      const bool wet = std::abs(root) <= 0.05 + from_floats;
      EXPECT_EQ(value(section, row, "inside"), wet ? 1.0 : 0.0);
      const double u = wet ? (1 - 0.8 * f) * root : root;
      EXPECT_NEAR(value(section, row, "u"), u, from_floats);
      EXPECT_NEAR(value(section, row, "d"), root - u, from_floats);
      EXPECT_NEAR(value(section, row, "x"), 3.0 * u, from_floats);
      EXPECT_NEAR(value(section, row, "y"), 0.2 * value(section, row, "h"), from_floats);
    }
  }
}

TEST(ClumpSection, TheDisplacementIsThatOfTheDrawnPoint) {
  // With "literal", d = gain r rho f (p - c) for the point p at which the strand is drawn (S Eq. 5).
  Scene scene = clumped("literal", 0.5f);
  scene.clump.gain = 70;
  const Section section = diagrams::clump_section(scene, 1.0);
  for (const auto& row : section.rows)
    if (value(section, row, "inside") > 0) {
      EXPECT_NEAR(value(section, row, "d"), 3.5 * 0.8 * value(section, row, "f") * value(section, row, "u"),
                  from_floats);
    }
}

TEST(CurlSection, IsAHelixWhoseRadiusGrowsAndShrinksWithTheWetness) {
  Scene scene;
  scene.fur.length = 0.2f;
  scene.fur.layer_spacing = "uniform";
  scene.curl.radius = 0.03f;
  scene.curl.turns = 2.0f;
  const Section section = diagrams::curl_section(scene);
  std::size_t wettest = 0;
  for (const auto& row : section.rows) {
    const double rho = value(section, row, "rho"), h = value(section, row, "h");
    const double angle = 2 * std::numbers::pi * 2 * h, radius = (1 - rho) * 0.03 * h;
    EXPECT_NEAR(value(section, row, "x"), radius * std::cos(angle), from_floats);
    EXPECT_NEAR(value(section, row, "y"), radius * std::sin(angle), from_floats);
    EXPECT_NEAR(value(section, row, "z"), 0.2 * h, from_floats);
    wettest += rho == 1.0;
  }
  EXPECT_EQ(3 * wettest, section.rows.size());
}

TEST(LayerSection, CutsEveryLayerOverThePlane) {
  Scene scene = synthetic::lively_scene();
  scene.fur.layers = 4;
  scene.fur.length = 0.25f;
  scene.fur.comb = scene.fur.comb_noise = 0;
  scene.fur.layer_spacing = "uniform";
  scene.curl.radius = 0;
  scene.dynamics.wind.strength = 0;
  scene.dynamics.gravity = glm::vec3(0);
  // A square of the side 2 in the plane y = 0 that faces +y; v runs along -z.
  const synthetic::Surface floor{[](double u, double v) { return glm::dvec3(2 * u - 1, 0, 1 - 2 * v); }};
  const FrameInput input = synthetic::frame(scene, floor, 3, 3, 0);
  const Section section = diagrams::layer_section(input, 1);
  // The plane z = 0 cuts the middle row of three quads, each into two segments.
  ASSERT_EQ(section.rows.size(), 6u * 2u * 5u);
  double least = 1, most = -1;
  for (const auto& row : section.rows) {
    const double layer = value(section, row, "layer");
    EXPECT_NEAR(value(section, row, "y"), 0.25 * (layer + 1) / 4, from_floats);
    EXPECT_NEAR(value(section, row, "h"), (layer + 1) / 4, exact);
    least = std::min(least, value(section, row, "x"));
    most = std::max(most, value(section, row, "x"));
  }
  EXPECT_NEAR(least, -1, from_floats);
  EXPECT_NEAR(most, 1, from_floats);
}

TEST(Section, IsWrittenAsCsv) {
  EXPECT_EQ(diagrams::csv_of({{"a", "b"}, {{1, 0.25}, {-1, 1.0 / 3}}}), "a,b\n1,0.25\n-1,0.333333333\n");
}

}  // namespace
}  // namespace pelage
