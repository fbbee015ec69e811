// Tests the exact distances from a closed mesh, and the coarse distance field of a body.
#include "harness/distance/field.hpp"

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "harness/error.hpp"
#include "harness/prepare/random.hpp"
#include "tests/strands/support/meshes.hpp"
#include "tests/support/files.hpp"

namespace pelage::strands {
namespace {

constexpr double chord = 2e-3;  // largest distance between the sphere and its mesh of 48 rows

glm::vec3 random_point(std::uint64_t i) {
  const Random random(3, 1);
  return 1.5f * glm::vec3(random.symmetric(i, 0), random.symmetric(i, 1), random.symmetric(i, 2));
}

TEST(ClosedSurface, HasTheDistancesOfASphere) {
  const ClosedSurface surface(sphere_mesh());
  int inside = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const glm::vec3 p = random_point(i);
    const double exact = glm::length(glm::dvec3(p)) - 1;
    EXPECT_NEAR(surface.distance(p), exact, chord) << i;
    inside += surface.winding(glm::dvec3(p)) > 0;
    if (std::abs(exact) > chord) {
      EXPECT_EQ(surface.winding(glm::dvec3(p)), exact < 0 ? 1 : 0) << i;
    }
  }
  EXPECT_GT(inside, 100);
}

// The rays through these points hit edges and corners of triangles.
TEST(ClosedSurface, CountsEachTriangleOnceOnRaysThroughEdgesAndCorners) {
  const auto mesh = sphere_mesh(12);
  const ClosedSurface surface(mesh);
  for (const glm::vec3& v : mesh->position)
    for (const double x : {-1.5, 0.0, 1.5}) {
      const glm::dvec3 p(x, v.y, v.z);
      if (std::abs(glm::length(p) - 1) < 0.1) continue;
      EXPECT_EQ(surface.winding(p), glm::length(p) < 1 ? 1 : 0) << p.x << " " << p.y << " " << p.z;
    }
}

// One triangle is missing. All rays to its points, and to its corners and edges, must count the filling once.
TEST(ClosedSurface, ClosesSmallHoles) {
  auto mesh = sphere_mesh(12);
  const glm::uvec3 gone = mesh->triangle[100];
  mesh->triangle.erase(mesh->triangle.begin() + 100);
  EXPECT_TRUE(is_closed(*mesh));
  const ClosedSurface surface(mesh);
  const glm::dvec3 a(mesh->position[gone.x]), b(mesh->position[gone.y]), c(mesh->position[gone.z]);
  for (int i = 0; i <= 4; ++i)
    for (int k = 0; i + k <= 4; ++k) {
      const glm::dvec3 p = a + 0.25 * i * (b - a) + 0.25 * k * (c - a);
      EXPECT_EQ(surface.winding({0, p.y, p.z}), 1) << i << " " << k;
      EXPECT_EQ(surface.winding({p.x < 0 ? -2 : 2, p.y, p.z}), 0) << i << " " << k;
    }
}

TEST(ClosedSurface, RefusesAnOpenMesh) {
  auto mesh = sphere_mesh(12);
  EXPECT_TRUE(is_closed(*mesh));
  mesh->triangle.erase(mesh->triangle.begin(),
                       mesh->triangle.begin() + 24);  // the fan at the end of the tube
  EXPECT_FALSE(is_closed(*mesh));
  EXPECT_THROW(ClosedSurface{mesh}, InputError);
  EXPECT_THROW(distance_field(mesh, 16), InputError);
  mesh->triangle.resize(1);  // three edges are few, but one triangle is no body
  EXPECT_FALSE(is_closed(*mesh));
}

TEST(DistanceField, IsTheDistanceOfASphereWithinTheInterpolation) {
  const auto mesh = sphere_mesh();
  for (const int cells : {16, 32}) {
    const DistanceField f = distance_field(mesh, cells);
    EXPECT_NEAR(double(f.cell), 2.0 / cells, 1e-6);
    double worst = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const glm::dvec3 p(random_point(i));
      const double distance = glm::length(p) - 1;
      if (std::abs(distance) > 0.1) continue;
      worst = std::max(worst, std::abs(value_at(f, p) - distance));
    }
    // Trilinear interpolation of a function whose second derivatives are about 1 / R has an error of at most
    // three times cell^2 / 8.
    const double interpolation = 3 * double(f.cell) * double(f.cell) / 8, limit = interpolation + chord;
    EXPECT_LT(worst, limit);
    EXPECT_GT(worst, 1e-5);
  }
  EXPECT_THROW(distance_field(mesh, 3), InputError);
  EXPECT_THROW(distance_field(mesh, 257), InputError);
}

TEST(DistanceField, ComesFromTheCacheWithTheSameBits) {
  const pelage::test::Folder folder;
  ::setenv("XDG_CACHE_HOME", folder.path.c_str(), 1);
  auto mesh = sphere_mesh(12);
  mesh->hash = "sphere-of-the-test";
  const auto first = kept_distance_field(mesh, 12);
  EXPECT_FALSE(fs::is_empty(folder.path / "pelage/fields"));
  mesh->triangle.resize(100);  // the cache is read, so nothing notices
  const auto second = kept_distance_field(mesh, 12);
  EXPECT_EQ(first->distance, second->distance);
  EXPECT_EQ(first->nodes, second->nodes);
  EXPECT_EQ(first->origin, second->origin);
  EXPECT_THROW(kept_distance_field(mesh, 13), InputError);
  ::unsetenv("XDG_CACHE_HOME");
}

}  // namespace
}  // namespace pelage::strands
