#include "harness/prepare/strands.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/mesh/mesh.hpp"
#include "tests/prepare/meshes.hpp"

namespace pelage {
namespace {

const Skin& torus() {
  static const Skin skin = weld(*load_model("torus"));
  return skin;
}

TEST(Strands, UprightUnlessCombed) {
  FurScene fur;
  fur.comb = 0;
  fur.comb_noise = 0;
  const StrandSet set = make_strands(torus(), fur, {});
  ASSERT_EQ(set.anchor.size(), torus().triangle.size());
  for (std::size_t f = 0; f < set.anchor.size(); ++f) {
    EXPECT_EQ(set.anchor[f], fur.length * set.normal[f]);
    EXPECT_NEAR(glm::length(set.normal[f]), 1.0, 1e-6);
  }
}

TEST(Strands, CombedAnchorsHaveTheFursLengthAndStayOutside) {
  FurScene fur;
  fur.comb_noise = 0.3f;
  const StrandSet set = make_strands(torus(), fur, {});
  int leaning = 0;
  for (std::size_t f = 0; f < set.anchor.size(); ++f) {
    EXPECT_NEAR(glm::length(set.anchor[f]), fur.length, 1e-6 * fur.length);
    const float upright = glm::dot(set.anchor[f], set.normal[f]) / fur.length;
    EXPECT_GT(upright, 0.5f);
    leaning += upright < 0.95f;
  }
  EXPECT_GT(leaning, int(set.anchor.size()) / 3);
}

TEST(Strands, CombRunsAlongItsDirection) {
  FurScene fur;
  fur.comb_direction = {1, 0, 0};
  const Skin skin = weld(*test::two_charts());
  const StrandSet set = make_strands(skin, fur, {});
  for (const glm::vec3& a : set.anchor) {
    EXPECT_GT(a.x, 0.3f * fur.length);
    EXPECT_NEAR(a.z, 0.0f, 1e-6f);
  }
}

TEST(Strands, CombDoesNotJumpBetweenNeighbours) {
  FurScene fur;
  const Skin& skin = torus();
  const StrandSet set = make_strands(skin, fur, {});
  double worst = 0;
  for (std::size_t w = 0; w < skin.position.size(); ++w)
    for (std::uint32_t k = set.row[w] + 1; k < set.row[w + 1]; ++k) {
      const double bend = std::acos(std::clamp(
          double(glm::dot(set.anchor[set.face[k]], set.anchor[set.face[k - 1]])) / fur.length / fur.length,
          -1.0, 1.0));
      const double crease = std::acos(
          std::clamp(double(glm::dot(set.normal[set.face[k]], set.normal[set.face[k - 1]])), -1.0, 1.0));
      worst = std::max(worst, bend - crease);
    }
  // The tilt of the strands changes fastest at points where the comb direction is normal to the surface. If
  // the surface normal turns there by a small angle, the tangent of the tilt angle changes by 2.4 times this
  // angle. The factor is fur.comb / least_grip = 0.6 / 0.25 (least_grip is defined in
  // harness/prepare/strands.cpp). Between adjacent faces the normal turns by 5.5 degrees. If the tilt were
  // discontinuous at such a point, adjacent strands would differ by 90 degrees.
  EXPECT_LT(worst * 180 / std::numbers::pi, 2.4 * 5.5);
}

TEST(Strands, WeightsAreAMeanByArea) {
  const StrandSet set = make_strands(torus(), {}, {});
  ASSERT_EQ(set.row.size(), torus().position.size() + 1);
  ASSERT_EQ(set.row.back(), set.face.size());
  ASSERT_EQ(set.face.size(), 3 * torus().triangle.size());
  for (std::size_t w = 0; w + 1 < set.row.size(); ++w) {
    double sum = 0;
    for (std::uint32_t k = set.row[w]; k < set.row[w + 1]; ++k) {
      sum += double(set.weight[k]);
      const glm::uvec3 t = torus().triangle[set.face[k]];
      EXPECT_TRUE(t.x == w || t.y == w || t.z == w);
      EXPECT_NEAR(set.weight[k] / set.weight[set.row[w]],
                  torus().area[set.face[k]] / torus().area[set.face[set.row[w]]], 1e-5);
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
  }
}

TEST(Strands, GustsTravelAlongTheWind) {
  WindScene wind;
  wind.direction = {0, 0, 3};
  wind.wavelength = 0.5f;
  const StrandSet set = make_strands(torus(), {}, wind);
  for (std::size_t f = 0; f < set.root.size(); f += 97) {
    const double phase = 2 * std::numbers::pi * double(set.root[f].z) / 0.5;
    EXPECT_NEAR(set.phase[f].x, std::cos(phase), 1e-5);
    EXPECT_NEAR(set.phase[f].y, std::sin(phase), 1e-5);
  }
}

TEST(Strands, RestTipsAreTheWeightedMean) {
  FurScene fur;
  fur.comb = 0;
  const Skin skin = weld(*test::two_charts());
  const auto tips = rest_tips(skin, make_strands(skin, fur, {}));
  for (std::size_t w = 0; w < tips.size(); ++w)
    EXPECT_LT(glm::distance(tips[w], glm::vec3(skin.position[w]) + glm::vec3(0, fur.length, 0)), 1e-6f);
}

}  // namespace
}  // namespace pelage
