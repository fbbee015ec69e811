// Tests the last step of mesh preparation: rotation, and scaling to the unit sphere.
#include "harness/mesh/finish.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace pelage {
namespace {

void expect_near(glm::dvec3 a, glm::dvec3 b) {
  EXPECT_LT(glm::distance(a, b), 1e-6) << a.x << ' ' << a.y << ' ' << a.z;
}

// Rotations are right-handed. A rotation by 90 degrees about x maps y to z. A rotation by 90 degrees about y
// maps z to x. A rotation by 90 degrees about z maps x to y.
TEST(Rotation, turns_about_x_then_y_then_z) {
  expect_near(rotation_matrix({90, 0, 0}) * glm::dvec3(0, 1, 0), {0, 0, 1});
  expect_near(rotation_matrix({0, 90, 0}) * glm::dvec3(0, 0, 1), {1, 0, 0});
  expect_near(rotation_matrix({0, 0, 90}) * glm::dvec3(1, 0, 0), {0, 1, 0});
  expect_near(rotation_matrix({90, 90, 0}) * glm::dvec3(0, 1, 0), {1, 0, 0});
  expect_near(rotation_matrix({0, 90, 90}) * glm::dvec3(0, 0, 1), {0, 1, 0});
  expect_near(rotation_matrix({90, 90, 90}) * glm::dvec3(0, 1, 0), {0, 1, 0});
}

TEST(Finish, turns_a_surface_and_fits_it_into_the_unit_sphere) {
  Surface surface;
  // A triangle that is elongated along y. Its bounding sphere has centre (5, 5, 5) and radius 2.
  surface.point = {{5, 7, 5}, {5, 3, 5}, {5, 5, 6}};
  surface.triangle = {{0, 1, 2}};
  surface.uv = {{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)}};
  const Mesh mesh = finish(surface, "stick", {90, 90, 0});
  ASSERT_EQ(mesh.position.size(), 3u);
  double right = 0, left = 0;
  for (const glm::vec3& p : mesh.position) {
    EXPECT_LE(glm::length(p), 1.0001f);
    right = std::max(right, double(p.x));
    left = std::min(left, double(p.x));
  }
  EXPECT_NEAR(right, 1, 1e-6);
  EXPECT_NEAR(left, -1, 1e-6);
}

}  // namespace
}  // namespace pelage
