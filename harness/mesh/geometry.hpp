// The bounding sphere of points.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

namespace pelage {

struct Sphere {
  glm::dvec3 centre{0};
  double radius = 0;
};

/// Returns the smallest sphere that contains all points (CGAL's Min_sphere_of_spheres_d).
Sphere bounding_sphere(const std::vector<glm::dvec3>& points);

}  // namespace pelage
