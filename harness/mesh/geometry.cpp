#include "harness/mesh/geometry.hpp"

#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Simple_cartesian.h>

namespace pelage {

Sphere bounding_sphere(const std::vector<glm::dvec3>& points) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Traits = CGAL::Min_sphere_of_points_d_traits_3<Kernel, double>;
  std::vector<Kernel::Point_3> list;
  list.reserve(points.size());
  for (const glm::dvec3& p : points) list.emplace_back(p.x, p.y, p.z);
  CGAL::Min_sphere_of_spheres_d<Traits> sphere(list.begin(), list.end());
  const auto* centre = sphere.center_cartesian_begin();
  return {{centre[0], centre[1], centre[2]}, sphere.radius()};
}

}  // namespace pelage
