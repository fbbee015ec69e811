// Tests the last step of mesh preparation: rotation, also by MeshOptions::rotate, and scaling to the unit
// sphere.
#include "harness/mesh/finish.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "harness/error.hpp"
#include "tests/mesh/mesh_files.hpp"

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
  EXPECT_NEAR(mesh.length_per_uv.x, 1 / (1 - 4.0 / 256),
              1e-6);  // the map fills the square but for its margin
}

// The map of a file stays unchanged in the whole unit square.
TEST(Finish, fits_a_map_that_leaves_the_unit_square) {
  for (const glm::dvec2 by : {glm::dvec2(0, 0), {-0.01, 0}, {0, -0.01}, {0.01, 0}, {0, 0.01}}) {
    Surface surface;
    surface.keep_uv = true;
    surface.uv = {{glm::dvec2(0, 0) + by, glm::dvec2(1, 0) + by, glm::dvec2(1, 1) + by}};
    const auto before = surface.uv;
    fit_uv(surface);
    EXPECT_EQ(surface.uv == before, by == glm::dvec2(0)) << by.x << ' ' << by.y;
  }
}

TEST(Rotate, KeepsTheSurfaceAndTheMap) {
  const auto plain = load_model("banisch-dog");
  MeshOptions options;
  options.rotate = {10, 200, -30};
  const auto square = load_model("square", options);
  EXPECT_TRUE(!bits_of_cgal || square->hash == "bbdd81b835958ed2") << square->hash;
  const auto turned = load_model("banisch-dog", options);
  ASSERT_EQ(turned->position.size(), plain->position.size());
  ASSERT_EQ(turned->triangle.size(), plain->triangle.size());
  EXPECT_EQ(turned->welded, plain->welded);
  EXPECT_EQ(turned->length_per_uv, plain->length_per_uv);
  // A rotation changes no UV, by which this sorts the corners.
  const auto corners = [](const Mesh& mesh, const glm::dmat3& matrix) {
    std::vector<std::array<double, 15>> all;
    for (const glm::uvec3& t : mesh.triangle) {
      auto& triangle = all.emplace_back();
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3 p = matrix * glm::dvec3(mesh.position[t[k]]);
        const double corner[] = {mesh.uv[t[k]].x, mesh.uv[t[k]].y, p.x, p.y, p.z};
        std::copy_n(corner, 5, triangle.begin() + std::ptrdiff_t(5) * k);
      }
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  const auto before = corners(*plain, rotation_matrix(options.rotate)),
             after = corners(*turned, glm::dmat3(1));
  for (std::size_t f = 0; f < before.size(); ++f)
    for (std::size_t k = 0; k < 15; ++k) ASSERT_NEAR(after[f][k], before[f][k], 1e-6);
  EXPECT_TRUE(std::is_sorted(turned->weld.begin(), turned->weld.end()));
}

TEST(Rotate, RefusesWhatIsNoAngle) {
  for (const float angle : {361.0f, std::numeric_limits<float>::quiet_NaN()}) {
    MeshOptions options;
    options.rotate = {0, angle, 0};
    EXPECT_THROW(load_model("square", options), InputError);
  }
}

}  // namespace
}  // namespace pelage
