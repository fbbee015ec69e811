#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "harness/error.hpp"
#include "harness/mesh/mesh.hpp"

namespace pelage {
namespace {

double uv_area(const Mesh& mesh) {
  double area = 0;
  for (const glm::uvec3& t : mesh.triangle) {
    const glm::dvec2 a(mesh.uv[t.x]), b(mesh.uv[t.y]), c(mesh.uv[t.z]);
    const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    EXPECT_GT(twice, 0);
    area += 0.5 * twice;
  }
  return area;
}

TEST(Torus, is_72_by_65_quads_with_a_map_that_wraps) {
  const auto mesh = load_model("torus");
  EXPECT_EQ(mesh->triangle.size(), 9360u);
  EXPECT_EQ(mesh->welded, 72u * 65u);
  EXPECT_EQ(mesh->position.size(), 73u * 66u);
  EXPECT_TRUE(mesh->periodic_uv);
  EXPECT_NEAR(uv_area(*mesh), 1.0, 1e-5);
  // The torus has the major radius 1 / 1.4 and the minor radius 0.4 / 1.4, so that it fits into the unit
  // sphere. Polygons of 72 and 65 edges approximate the two circles of the torus, and are slightly shorter
  // than the circles.
  EXPECT_NEAR(mesh->length_per_uv.x, 2 * M_PI / 1.4, 0.01);
  EXPECT_NEAR(mesh->length_per_uv.y, 2 * M_PI * 0.4 / 1.4, 0.01);
  for (const glm::uvec3& t : mesh->triangle) {
    const glm::vec3 a = mesh->position[t.x], b = mesh->position[t.y], c = mesh->position[t.z];
    EXPECT_LE(glm::length(a), 1.0001f);
    const glm::vec3 normal = glm::cross(b - a, c - a);
    EXPECT_GT(glm::length(normal), 0.0f);
  }
}

TEST(Torus, is_as_fine_as_its_name_says) {
  const auto coarse = load_model("torus-12x10");
  EXPECT_EQ(coarse->triangle.size(), 240u);
  EXPECT_EQ(coarse->welded, 120u);
  EXPECT_TRUE(load_model("torus-72x65")->position == load_model("torus")->position);
  EXPECT_THROW(load_model("torus-2x9"), InputError);
  EXPECT_THROW(load_model("torus-9999x9999"), InputError);
}

TEST(Square, of_the_grass_has_13_vertices_and_16_faces) {
  const auto mesh = load_model("banisch-grass");
  EXPECT_EQ(mesh->triangle.size(), 16u);
  EXPECT_EQ(mesh->position.size(), 13u);
  EXPECT_EQ(mesh->welded, 13u);
  EXPECT_FALSE(mesh->periodic_uv);
  for (const glm::uvec3& t : mesh->triangle) {
    const glm::vec3 a = mesh->position[t.x], b = mesh->position[t.y], c = mesh->position[t.z];
    EXPECT_GT(glm::cross(b - a, c - a).y, 0.0f);
  }
  const double margin = 2.0 / 256;
  EXPECT_NEAR(uv_area(*mesh), (1 - 2 * margin) * (1 - 2 * margin), 1e-6);
}

}  // namespace
}  // namespace pelage
