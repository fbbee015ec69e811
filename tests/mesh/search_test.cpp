#include "harness/mesh/search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

namespace pelage {
namespace {

glm::vec3 at(const Mesh& mesh, const SurfacePlace& place) {
  const glm::uvec3 t = mesh.triangle[place.triangle];
  return place.weight.x * mesh.position[t.x] + place.weight.y * mesh.position[t.y] +
         place.weight.z * mesh.position[t.z];
}

TEST(SurfaceSearch, the_centroid_of_every_face_is_closest_to_itself) {
  const auto mesh = load_model("torus");
  const SurfaceSearch search(mesh);
  for (std::uint32_t f = 0; f < mesh->triangle.size(); f += 7) {
    const glm::uvec3 t = mesh->triangle[f];
    const glm::vec3 centroid = (mesh->position[t.x] + mesh->position[t.y] + mesh->position[t.z]) / 3.0f;
    const SurfacePlace place = search.closest(centroid);
    EXPECT_EQ(place.triangle, f);
    const glm::vec2 uv = (mesh->uv[t.x] + mesh->uv[t.y] + mesh->uv[t.z]) / 3.0f;
    EXPECT_LT(glm::distance(place.uv, uv), 1e-5f);
  }
}

TEST(SurfaceSearch, no_vertex_is_nearer_than_the_closest_place) {
  const auto mesh = load_model("torus");
  const SurfaceSearch search(mesh);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> anywhere(-1.5f, 1.5f);
  for (int i = 0; i < 100; ++i) {
    const glm::vec3 p(anywhere(random), anywhere(random), anywhere(random));
    const SurfacePlace place = search.closest(p);
    EXPECT_LT(glm::distance(at(*mesh, place), place.point), 1e-5f);
    float nearest = std::numeric_limits<float>::max();
    for (const glm::vec3& q : mesh->position) nearest = std::min(nearest, glm::distance(p, q));
    EXPECT_LE(glm::distance(p, place.point), nearest + 1e-6f);
    // Lengths are in units of the model's radius R. No edge is longer than 0.1, so every surface point is
    // less than 0.08 away from a vertex.
    EXPECT_GT(glm::distance(p, place.point), nearest - 0.08f);
  }
}

TEST(SurfaceSearch, a_ray_meets_the_near_side_first_and_may_miss) {
  const auto mesh = load_model("banisch-grass");
  const SurfaceSearch search(mesh);
  const auto hit = search.ray({0.1f, 2.0f, 0.2f}, {0.0f, -0.5f, 0.0f});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->point.y, 0.0f, 1e-6f);
  EXPECT_NEAR(hit->point.x, 0.1f, 1e-6f);
  // The model is a square with the side sqrt(2), in units of the model's radius. u increases with x, and v
  // increases with -z. `scale` is the number of UV units per unit of length.
  const float scale = (1 - 2 * 2.0f / 256) / std::sqrt(2.0f);
  EXPECT_NEAR(hit->uv.x, 0.5f + 0.1f * scale, 1e-5f);
  EXPECT_NEAR(hit->uv.y, 0.5f - 0.2f * scale, 1e-5f);
  EXPECT_FALSE(search.ray({0.1f, 2.0f, 0.2f}, {0.0f, 1.0f, 0.0f}));

  const auto torus = load_model("torus");
  const SurfaceSearch around(torus);
  const glm::vec3 eye(1.3f, 1.15f, 2.35f);
  for (const glm::uvec3& t : torus->triangle) {
    const glm::vec3 a = torus->position[t.x], b = torus->position[t.y], c = torus->position[t.z];
    const glm::vec3 target = (a + b + c) / 3.0f;
    const auto place = around.ray(eye, target - eye);
    ASSERT_TRUE(place);
    // The test skips faces that are nearly parallel to the ray. For these, the rounding error of the ray's
    // direction moves the intersection far along the ray.
    if (std::abs(glm::dot(glm::normalize(glm::cross(b - a, c - a)), glm::normalize(target - eye))) < 0.05f)
      continue;
    EXPECT_LE(glm::distance(eye, place->point), glm::distance(eye, target) + 1e-5f);
    EXPECT_LT(glm::distance(at(*torus, *place), place->point), 1e-5f);
  }
}

}  // namespace
}  // namespace pelage
