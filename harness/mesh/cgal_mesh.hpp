// CGAL's mesh type, and its conversions from and to Surface. Only sources that call CGAL's mesh functions
// include this header.
#pragma once
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "harness/mesh/surface.hpp"

namespace pelage {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedron = CGAL::Surface_mesh<Kernel::Point_3>;

inline Polyhedron to_cgal(const Surface& surface) {
  Polyhedron mesh;
  mesh.reserve(unsigned(surface.point.size()), unsigned(surface.triangle.size()) * 2,
               unsigned(surface.triangle.size()));
  for (const glm::dvec3& p : surface.point) mesh.add_vertex({p.x, p.y, p.z});
  for (const auto& [a, b, c] : surface.triangle)
    mesh.add_face(Polyhedron::Vertex_index(a), Polyhedron::Vertex_index(b), Polyhedron::Vertex_index(c));
  return mesh;
}

inline Surface from_cgal(Polyhedron& mesh) {
  if (mesh.has_garbage()) mesh.collect_garbage();
  Surface surface;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    surface.point.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    surface.triangle.push_back({mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))});
  }
  return surface;
}

}  // namespace pelage
