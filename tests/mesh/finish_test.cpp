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

// A pyramid with the base 2 x 1 and the height 3 along z. Its extents along the three axes differ.
const char* const pyramid =
    "OFF\n5 6 0\n-1 -0.5 0\n1 -0.5 0\n1 0.5 0\n-1 0.5 0\n0 0 3\n"
    "3 0 2 1\n3 0 3 2\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";

glm::vec3 extent(const Mesh& mesh) {
  glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
  for (const glm::vec3& p : mesh.position) low = glm::min(low, p), high = glm::max(high, p);
  return high - low;
}

std::shared_ptr<const Mesh> turned_pyramid(const test::Folder& folder, glm::vec3 degrees) {
  MeshOptions options = fresh();
  options.rotate = degrees;
  return load_model(folder.write("pyramid.off", pyramid), options);
}

TEST(Rotate, TurnsAboutXThenYThenZ) {
  const test::Folder folder;
  const auto plain = turned_pyramid(folder, glm::vec3(0));
  const glm::vec3 size = extent(*plain);
  ASSERT_GT(size.z, size.x);
  ASSERT_GT(size.x, size.y);

  // The rotation about x maps the direction (0, 0, 1) to (0, 1, 0), and the rotation about z then maps (0, 1,
  // 0) to (-1, 0, 0). In the reverse order, (0, 0, 1) would be mapped to (0, 1, 0).
  const auto both = turned_pyramid(folder, {-90, 0, 90});
  EXPECT_NEAR(extent(*both).x, size.z, 1e-5f);
  EXPECT_NEAR(extent(*both).y, size.x, 1e-5f);
  EXPECT_NEAR(extent(*both).z, size.y, 1e-5f);
  EXPECT_NE(both->hash, plain->hash);
}

TEST(Rotate, KeepsTheSurfaceAndTheMap) {
  const auto plain = load_model("banisch-dog");
  MeshOptions options;
  options.rotate = {10, 200, -30};
  const auto turned = load_model("banisch-dog", options);
  ASSERT_EQ(turned->position.size(), plain->position.size());
  ASSERT_EQ(turned->triangle.size(), plain->triangle.size());
  EXPECT_EQ(turned->welded, plain->welded);
  EXPECT_EQ(turned->length_per_uv, plain->length_per_uv);
  // The test identifies a triangle by its UV and its side lengths, because a rotation changes neither.
  using Sides = std::array<float, 9>;
  const auto fingerprints = [](const Mesh& mesh) {
    std::vector<Sides> all;
    all.reserve(mesh.triangle.size());
    for (const glm::uvec3& t : mesh.triangle) {
      Sides sides{};
      for (int k = 0; k < 3; ++k) {
        const auto side = std::size_t(k);
        sides[2 * side] = mesh.uv[t[k]].x;
        sides[2 * side + 1] = mesh.uv[t[k]].y;
        sides[6 + side] = glm::distance(mesh.position[t[k]], mesh.position[t[(k + 1) % 3]]);
      }
      all.push_back(sides);
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  const auto before = fingerprints(*plain), after = fingerprints(*turned);
  for (std::size_t f = 0; f < before.size(); ++f) {
    for (std::size_t k = 0; k < 6; ++k) ASSERT_EQ(after[f][k], before[f][k]);
    for (std::size_t k = 6; k < 9; ++k) ASSERT_NEAR(after[f][k], before[f][k], 1e-6f);
  }
  for (std::size_t i = 1; i < turned->weld.size(); ++i) {
    ASSERT_LE(turned->weld[i - 1], turned->weld[i]);
    if (turned->weld[i - 1] == turned->weld[i]) {
      ASSERT_EQ(turned->position[i - 1], turned->position[i]);
    }
  }
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
