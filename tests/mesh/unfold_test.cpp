// Tests map_quality(), which decides whether a UV map is usable.
#include "harness/mesh/unfold.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace pelage {
namespace {

/// Returns the quality of a UV map of `faces` triangles side by side. The first `flipped` triangles are
/// flipped.
MapQuality quality_of(std::size_t faces, std::size_t flipped) {
  std::vector<glm::dvec2> uv;
  std::vector<Surface::Triangle> triangles;
  for (std::size_t f = 0; f < faces; ++f) {
    const auto first = std::uint32_t(uv.size());
    for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)})
      uv.push_back(corner + glm::dvec2(f, 0));
    triangles.push_back({first, first + (f < flipped ? 2u : 1u), first + (f < flipped ? 1u : 2u)});
  }
  return map_quality(uv, triangles);
}

TEST(MapQuality, allows_one_flipped_face_in_fifty) {
  EXPECT_TRUE(quality_of(100, 0).usable);
  EXPECT_TRUE(quality_of(100, 2).usable);
  EXPECT_EQ(quality_of(100, 2).flipped, 2u);
  EXPECT_FALSE(quality_of(100, 3).usable);
  EXPECT_EQ(quality_of(100, 3).flipped, 3u);
}

TEST(MapQuality, asks_for_a_finite_map_of_some_area) {
  const std::vector<Surface::Triangle> one{{0, 1, 2}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(map_quality({{0, 0}, {1, 0}, {0, nan}}, one).usable);
  EXPECT_FALSE(map_quality({{0, 0}, {1, 0}, {2, 0}}, one).usable);
  EXPECT_TRUE(map_quality({{0, 0}, {1, 0}, {0, 1}}, one).usable);
}

}  // namespace
}  // namespace pelage
