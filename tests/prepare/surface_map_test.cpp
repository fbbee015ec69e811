// Tests surface_map(), which stores a surface point in each texel. If the centre of a texel is inside a
// triangle, the texel stores the surface point at its centre. All other texels are uncovered. An uncovered
// texel stores the point of the nearest covered texel.
#include "harness/prepare/surface_map.hpp"

#include <gtest/gtest.h>

#include "harness/mesh/mesh.hpp"

namespace pelage {
namespace {

constexpr int size = 32;

/// Returns a mesh that maps every UV (u, v) in [low, 1] x [0, 1] to the point (u, v, 0).
Mesh strip(float low, bool periodic) {
  Mesh mesh;
  mesh.uv = {{low, 0}, {1, 0}, {1, 1}, {low, 1}};
  for (const glm::vec2& uv : mesh.uv) mesh.position.push_back({uv, 0});
  mesh.triangle = {{0, 1, 2}, {0, 2, 3}};
  mesh.weld = {0, 1, 2, 3};
  mesh.welded = 4;
  mesh.periodic_uv = periodic;
  return mesh;
}

glm::vec2 centre(int x, int y) {
  return {(float(x) + 0.5f) / size, (float(y) + 0.5f) / size};
}

TEST(SurfaceMap, ATexelHoldsThePointUnderItsCentre) {
  const auto map = surface_map(strip(0, false), size);
  ASSERT_EQ(map.size(), std::size_t(size * size));
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const glm::vec3 point = map[std::size_t(y) * std::size_t(size) + std::size_t(x)];
      EXPECT_NEAR(point.x, centre(x, y).x, 1e-6f);
      EXPECT_NEAR(point.y, centre(x, y).y, 1e-6f);
    }
}

// Texel columns 0 to 7 are outside the triangles. The nearest covered column is column 8. On a periodic map,
// however, columns 0 to 3 are nearer to column 31 than to column 8.
TEST(SurfaceMap, TheGutterOfAPeriodicMapWraps) {
  for (const bool periodic : {false, true}) {
    const auto map = surface_map(strip(0.25f, periodic), size);
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < 8; ++x) {
        const glm::vec3 point = map[std::size_t(y) * std::size_t(size) + std::size_t(x)];
        EXPECT_NEAR(point.x, centre(periodic && x < 4 ? 31 : 8, y).x, 1e-6f)
            << x << ' ' << y << ' ' << periodic;
        EXPECT_NEAR(point.y, centre(x, y).y, 1e-6f) << x << ' ' << y << ' ' << periodic;
      }
  }
}

}  // namespace
}  // namespace pelage
