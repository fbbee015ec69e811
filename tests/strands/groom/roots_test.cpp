// Tests the roots of strands: their number, their distances and their density.
#include "harness/strands/groom/roots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/error.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::strands {
namespace {

double everywhere(const Root&) {
  return 1;
}

std::vector<glm::dvec3> positions(const Mesh& mesh, const std::vector<Root>& roots, std::size_t count) {
  std::vector<glm::dvec3> result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(position_of(mesh, roots[i]));
  return result;
}

/// Returns the distance of each point to its nearest neighbour, by comparing all pairs.
std::vector<double> nearest(const std::vector<glm::dvec3>& points) {
  std::vector<double> result(points.size(), 1e9);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double d = glm::distance(points[i], points[j]);
      result[i] = std::min(result[i], d);
      result[j] = std::min(result[j], d);
    }
  return result;
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const glm::uvec3 t : mesh.triangle) {
    const glm::dvec3 a(mesh.position[t.x]), b(mesh.position[t.y]), c(mesh.position[t.z]);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

/// The least and the mean distance of a point to its nearest neighbour. Both are divided by the distance of
/// neighbours in a hexagonal packing with the same number of points per area. For random points without a
/// least distance, the mean is 0.47: their mean distance is 0.5 / sqrt(points per area), and the distance in
/// the packing is 1.07 / sqrt(points per area).
struct Spacing {
  double least, mean;
};
Spacing spacing(const Mesh& mesh, const std::vector<Root>& roots, std::size_t count) {
  const std::vector<double> distances = nearest(positions(mesh, roots, count));
  const double packed = std::sqrt(2 / std::sqrt(3.0) * area_of(mesh) / double(count));
  double sum = 0;
  for (const double d : distances) sum += d;
  return {*std::min_element(distances.begin(), distances.end()) / packed, sum / double(count) / packed};
}

TEST(Roots, AreOnTheSurfaceAndAsManyAsWanted) {
  const Mesh mesh = synthetic::grid(synthetic::torus(), 40, 20);
  for (const std::size_t count : {0u, 1u, 7u, 3000u}) {
    const auto roots = scatter_roots(mesh, everywhere, count, 1);
    ASSERT_EQ(roots.size(), count);
    for (const Root& root : roots) {
      ASSERT_LT(root.face, mesh.triangle.size());
      EXPECT_GE(std::min(root.weight.x, root.weight.y), 0.0f);
      EXPECT_LE(root.weight.x + root.weight.y, 1.0f);
    }
  }
}

TEST(Roots, AndEveryPrefixAreBlueNoise) {
  const Mesh mesh = synthetic::grid(synthetic::torus(), 60, 30);
  const auto roots = scatter_roots(mesh, everywhere, 4000, 5);
  for (const std::size_t count : {250u, 400u, 1000u, 2300u, 4000u}) {
    const Spacing found = spacing(mesh, roots, count);
    EXPECT_GT(found.least, 0.55) << count;
    EXPECT_GT(found.mean, 0.7) << count;
  }
}

TEST(Roots, DependOnTheSeedAndOnNothingElse) {
  const Mesh mesh = synthetic::grid(synthetic::torus(), 40, 20);
  const auto a = scatter_roots(mesh, everywhere, 500, 1), again = scatter_roots(mesh, everywhere, 500, 1),
             more = scatter_roots(mesh, everywhere, 800, 1), other = scatter_roots(mesh, everywhere, 500, 2);
  const auto equal = [](const Root& x, const Root& y) { return x.face == y.face && x.weight == y.weight; };
  EXPECT_TRUE(std::equal(a.begin(), a.end(), again.begin(), again.end(), equal));
  EXPECT_TRUE(std::equal(a.begin(), a.end(), more.begin(), equal))
      << "fewer roots are a prefix of more roots";
  EXPECT_FALSE(std::equal(a.begin(), a.end(), other.begin(), other.end(), equal));
}

TEST(Roots, FollowTheDensity) {
  const Mesh mesh = synthetic::grid(synthetic::square(2), 16, 16);
  for (const double low : {0.5, 0.25, 1.0 / 16, 1.0 / 50}) {
    const auto density = [&](const Root& root) { return position_of(mesh, root).x < 0 ? low : 1.0; };
    const auto roots = scatter_roots(mesh, density, 4000, 3);
    const auto few = std::count_if(roots.begin(), roots.end(),
                                   [&](const Root& root) { return position_of(mesh, root).x < 0; });
    const double expected = 4000 * low / (1 + low);
    EXPECT_NEAR(double(few), expected, low < 1.0 / 16 ? 2.5 * std::sqrt(expected) : 0.06 * expected) << low;
  }
}

TEST(Roots, OfBothSidesOfAThinSheetDoNotRepelEachOther) {
  Mesh mesh = synthetic::grid(synthetic::square(2), 8, 8);
  const auto front = std::uint32_t(mesh.triangle.size());
  const auto vertices = std::uint32_t(mesh.position.size());
  for (std::uint32_t v = 0; v < vertices; ++v) {
    mesh.position.push_back(mesh.position[v] - glm::vec3(0, 0, 1e-4f));
    mesh.uv.push_back(mesh.uv[v]);
  }
  for (std::uint32_t f = 0; f < front; ++f) {
    const glm::uvec3 t = mesh.triangle[f];
    mesh.triangle.push_back(glm::uvec3(t.x, t.z, t.y) + glm::uvec3(vertices));
  }
  const auto roots = scatter_roots(mesh, everywhere, 2000, 4);
  std::vector<glm::dvec3> side;
  for (const Root& root : roots)
    if (root.face < front) side.push_back(position_of(mesh, root));
  EXPECT_NEAR(double(side.size()), 1000, 40);
  const auto distances = nearest(side);
  EXPECT_GT(*std::min_element(distances.begin(), distances.end()),
            0.5 * std::sqrt(2 / std::sqrt(3.0) * 4 / 1000));
}

// The density falls from 1 at x = -1 to 1/8 at x = 1, and is 0 where y > 0. In units of the distance that the
// density at the root gives, the distances to the nearest neighbours are those of blue noise.
TEST(Roots, KeepTheDistancesOfTheDensityWithinAMask) {
  const Mesh mesh = synthetic::grid(synthetic::square(2), 16, 16);
  const auto density = [&](const Root& root) {
    const glm::dvec3 p = position_of(mesh, root);
    return p.y > 0 ? 0.0 : std::pow(8.0, -(p.x + 1) / 2);
  };
  std::vector<bool> bare;
  for (std::uint32_t f = 0; f < mesh.triangle.size(); ++f)
    bare.push_back(position_of(mesh, {f, {1.0f / 3, 1.0f / 3}}).y > 0);
  const double total = 2 * (1 - 1.0 / 8) / std::log(8.0);  // integral of the density
  for (const bool skip : {false, true}) {
    const auto roots = scatter_roots(mesh, density, 4000, 6, skip ? bare : std::vector<bool>{});
    for (const std::size_t count : {500u, 4000u}) {
      const auto points = positions(mesh, roots, count);
      const auto distances = nearest(points);
      double least = 1e9, sum = 0;
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_LE(points[i].y, 0);
        const double per_area = double(count) / total * density(roots[i]);
        const double packed = std::sqrt(2 / std::sqrt(3.0) / per_area);
        least = std::min(least, distances[i] / packed);
        sum += distances[i] / packed;
      }
      EXPECT_GT(least, 0.45) << count;
      EXPECT_GT(sum / double(count), 0.7) << count;
    }
  }
}

TEST(Roots, ADensityOfZeroIsAnError) {
  const Mesh mesh = synthetic::grid(synthetic::torus(), 8, 8);
  EXPECT_THROW(scatter_roots(
                   mesh, [](const Root&) { return 0.0; }, 10, 1),
               InputError);
}

}  // namespace
}  // namespace pelage::strands
