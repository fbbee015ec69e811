// Tests the motion of a skin that deforms.
#include "harness/strands/body/skin.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "harness/error.hpp"
#include "tests/strands/support/meshes.hpp"

namespace pelage::strands {
namespace {

constexpr double T = 1.0 / 60;

glm::dvec3 turned_y(glm::dvec3 v, double angle) {
  return {std::cos(angle) * v.x + std::sin(angle) * v.z, v.y, std::cos(angle) * v.z - std::sin(angle) * v.x};
}

std::vector<glm::vec3> leaning(const Skin& skin) {
  std::vector<glm::vec3> rest;
  for (const glm::dvec3& n : skin.normal) rest.emplace_back(glm::normalize(n + 0.6 * any_tangent(n)));
  return rest;
}

template <class Map>
std::vector<glm::vec3> mapped(const Skin& skin, const Map& map) {
  std::vector<glm::vec3> points;
  for (const glm::dvec3& p : skin.position) points.emplace_back(map(p));
  return points;
}

TEST(SkinMotion, RotatesDirectionsWithARigidSkin) {
  const auto mesh = sphere_mesh(12);
  const Skin skin = weld(*mesh);
  const std::vector<glm::vec3> rest = leaning(skin);
  SkinMotion motion(*mesh, points_of(*mesh), rest);
  for (const double angle : {0.0, 0.4, 2.5}) {
    const SkinFrame f =
        motion.next(mapped(skin, [&](glm::dvec3 p) { return turned_y(p, angle) + glm::dvec3(1, 2, 3); }), T);
    for (std::size_t i = 0; i < rest.size(); ++i) {
      EXPECT_LT(glm::distance(glm::dvec3(f.rest[i]), turned_y(glm::dvec3(rest[i]), angle)), 3e-6) << i;
      EXPECT_LT(glm::distance(glm::dvec3(f.normal[i]), turned_y(skin.normal[i], angle)), 3e-6) << i;
    }
  }
}

// The twist of the cylinder is angle(y) = 0.5 y. The direction at rest keeps its angle to the normal. On the
// side of the cylinder, where the surface is sheared, it turns about the normal by half of the shear angle
// atan(0.5 * 0.4), up to the angles of the mesh.
TEST(SkinMotion, FollowsATwistingCylinder) {
  const auto mesh = cylinder_mesh();
  const Skin skin = weld(*mesh);
  const std::vector<glm::vec3> rest = leaning(skin);
  SkinMotion motion(*mesh, points_of(*mesh), rest);
  const SkinFrame f = motion.next(mapped(skin, [](glm::dvec3 p) { return turned_y(p, 0.5 * p.y); }), T);
  int checked = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    EXPECT_NEAR(glm::dot(f.rest[i], f.normal[i]), glm::dot(glm::dvec3(rest[i]), skin.normal[i]), 1e-5) << i;
    if (std::abs(skin.position[i].y) > 0.6) continue;
    const double angle = 0.5 * skin.position[i].y;
    EXPECT_LT(glm::distance(glm::dvec3(f.normal[i]), turned_y(skin.normal[i], angle)), 0.02) << i;
    const glm::dvec3 n(f.normal[i]), with_ring = turned_y(glm::dvec3(rest[i]), angle), now(f.rest[i]);
    const glm::dvec3 a = tangential(with_ring, n), b = tangential(now, n);
    const double shear = std::atan2(glm::dot(n, glm::cross(a, b)), glm::dot(a, b));
    EXPECT_NEAR(std::abs(shear), std::atan(0.2) / 2, 0.04) << i;
    ++checked;
  }
  EXPECT_GT(checked, 100);
}

TEST(SkinMotion, HasVelocityAndAccelerationOfAParabolaExactly) {
  const auto mesh = sphere_mesh(8);
  const Skin skin = weld(*mesh);
  SkinMotion motion(*mesh, points_of(*mesh), leaning(skin));
  const glm::dvec3 v(0.5, -0.25, 1), a(2, -4, 1);
  SkinFrame f;
  for (int k = 0; k < 4; ++k) {
    const double t = 0.25 * k;
    f = motion.next(mapped(skin, [&](glm::dvec3 p) { return p + v * t + 0.5 * a * t * t; }), 0.25);
  }
  for (std::size_t i = 0; i < f.root.size(); ++i) {
    EXPECT_LT(glm::distance(glm::dvec3(f.velocity[i]), v + a * 0.75), 1e-5) << i;
    EXPECT_LT(glm::distance(glm::dvec3(f.acceleration[i]), a), 3e-5) << i;
  }
}

TEST(SkinMotion, RefusesWrongCounts) {
  const auto mesh = sphere_mesh(8);
  EXPECT_THROW(SkinMotion(*mesh, points_of(*mesh), {{0, 1, 0}}), InputError);
  EXPECT_THROW(SkinMotion(*mesh, {mesh->welded}, {{0, 1, 0}}), InputError);
  SkinMotion motion(*mesh, points_of(*mesh), leaning(weld(*mesh)));
  EXPECT_THROW(motion.next({{0, 1, 0}}, T), InputError);
  EXPECT_THROW(motion.next(mesh->position, 0), InputError);
}

}  // namespace
}  // namespace pelage::strands
