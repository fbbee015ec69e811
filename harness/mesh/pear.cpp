#include <CGAL/IO/facets_in_complex_2_to_triangle_mesh.h>
#include <CGAL/Implicit_surface_3.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/make_surface_mesh.h>

#include <cmath>

#include "harness/mesh/cgal_mesh.hpp"
#include "harness/mesh/procedural.hpp"

namespace pelage {
namespace {

using Triangulation = CGAL::Surface_mesh_default_triangulation_3;
using Traits = Triangulation::Geom_traits;

// Negative inside: a wide ball below, a narrow one above, joined by a smooth minimum (radius of the blend
// 0.35), and a shallow dimple at the stem. The pear reaches from y = -1 to about 1.
double pear(const Traits::Point_3& p) {
  const double x = p.x(), y = p.y(), z = p.z(), across = x * x + z * z;
  const double low = std::sqrt(across + (y + 0.3) * (y + 0.3)) - 0.68;
  const double high = std::sqrt(across + (y - 0.62) * (y - 0.62)) - 0.27;
  const double blend = 0.6, h = std::max(blend - std::abs(low - high), 0.0) / blend;
  const double body = std::min(low, high) - h * h * blend / 4;
  const double dimple = 0.09 * std::exp(-(across + (y - 0.92) * (y - 0.92)) / 0.02);
  return body + dimple;
}

}  // namespace

Surface make_pear(double edge) {
  Triangulation triangulation;
  CGAL::Complex_2_in_triangulation_3<Triangulation> complex(triangulation);
  const CGAL::Implicit_surface_3<Traits, double (*)(const Traits::Point_3&)> surface(
      pear, Traits::Sphere_3({0, -0.1, 0}, 4.0), 1e-6);
  const CGAL::Surface_mesh_default_criteria_3<Triangulation> criteria(30, edge, edge);
  CGAL::make_surface_mesh(complex, surface, criteria, CGAL::Manifold_tag());
  Polyhedron mesh;
  CGAL::facets_in_complex_2_to_triangle_mesh(complex, mesh);
  return from_cgal(mesh);
}

}  // namespace pelage
