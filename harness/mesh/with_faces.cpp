#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/subdivision_method_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "harness/error.hpp"
#include "harness/mesh/cgal_mesh.hpp"
#include "harness/mesh/steps.hpp"

namespace SMS = CGAL::Surface_mesh_simplification;

namespace pelage {
namespace {

// Removes the lowest face that does not touch a border; `up` is the direction from low to high. Removing a
// face at a border could make the mesh non-manifold.
void drop_lowest_face(Polyhedron& mesh, glm::dvec3 up) {
  std::vector<std::pair<double, Polyhedron::Face_index>> inner;  // height and face
  for (const auto f : mesh.faces()) {
    const auto points = CGAL::vertices_around_face(mesh.halfedge(f), mesh);
    if (std::any_of(points.begin(), points.end(), [&](auto v) { return mesh.is_border(v); })) continue;
    auto& [height, face] = inner.emplace_back(0.0, f);
    for (const auto v : points) {
      const auto& p = mesh.point(v);
      height += glm::dot(up, glm::dvec3(p.x(), p.y(), p.z()));
    }
  }
  if (inner.empty()) return;
  const auto lowest = std::ranges::min_element(inner, {}, [](const auto& one) { return one.first; });
  CGAL::Euler::remove_face(mesh.halfedge(lowest->second), mesh);
}

}  // namespace

Surface with_faces(const Surface& surface, std::uint32_t faces, glm::dvec3 up, const std::string& name,
                   const std::function<void(double)>& part) {
  if (surface.triangle.size() == faces) return surface;
  Polyhedron mesh = to_cgal(surface);
  std::vector<std::string> notes = surface.notes;
  int rounds = 0;
  for (; mesh.number_of_faces() < faces; ++rounds) CGAL::Subdivision_method_3::Loop_subdivision(mesh);
  if (rounds > 0)
    notes.push_back(fmt::format("subdivided {} faces into {} by Loop subdivision (steps: {})",
                                surface.triangle.size(), mesh.number_of_faces(), rounds));

  const auto before = mesh.number_of_faces();
  // CGAL 5.5 provides only stop conditions on the number of edges. An edge collapse removes two faces, or one
  // face at a border, so the mesh has `faces` or `faces` + 1 faces at the end.
  const auto few_enough = [&](const auto&, const auto& profile, std::size_t, std::size_t) {
    const std::size_t now = profile.surface_mesh().number_of_faces();
    if (now <= faces + 1) return true;
    part(double(before - now) / double(before - faces));
    return false;
  };
  SMS::edge_collapse(mesh, few_enough, CGAL::parameters::filter(SMS::Bounded_normal_change_filter<>()));
  mesh.collect_garbage();
  if (mesh.number_of_faces() < before)
    notes.push_back(fmt::format("collapsed edges from {} faces to {}", before, mesh.number_of_faces()));
  if (mesh.number_of_faces() == faces + 1) {
    drop_lowest_face(mesh, up);
    mesh.collect_garbage();
    notes.push_back(
        "removed the lowest face, because the mesh had one face more than requested (a closed mesh has an even number of faces)");
  }
  if (mesh.number_of_faces() != faces)
    throw InputError(fmt::format(
        "{}: the mesh cannot be reduced to {} faces without flipping a face; give {} or another count", name,
        faces, mesh.number_of_faces()));
  Surface result = from_cgal(mesh);
  result.notes = notes;
  return result;
}

}  // namespace pelage
