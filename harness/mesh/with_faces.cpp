#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/subdivision_method_3.h>
#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <limits>

#include "harness/error.hpp"
#include "harness/mesh/cgal_mesh.hpp"
#include "harness/mesh/steps.hpp"

namespace SMS = CGAL::Surface_mesh_simplification;

namespace pelage {
namespace {

// A stop condition on the number of faces; CGAL 5.5 provides only conditions on the number of edges. An edge
// collapse removes two faces, or one face at a border, so the mesh has `faces` or `faces` + 1 faces at the
// end.
struct Few_enough_faces {
  std::size_t faces, before;
  const std::function<void(double)>* part;
  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const {
    const std::size_t now = profile.surface_mesh().number_of_faces();
    if (*part && now % 4096 < 2) (*part)(double(before - now) / double(before - faces));
    return now <= faces + 1;
  }
};

// Removes the lowest face that does not touch a border; `up` is the direction from low to high. Removing a
// face at a border could make the mesh non-manifold.
void drop_lowest_face(Polyhedron& mesh, glm::dvec3 up) {
  Polyhedron::Face_index lowest;
  double least = std::numeric_limits<double>::max();
  for (const auto f : mesh.faces()) {
    double height = 0;
    bool inner = true;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      const auto& p = mesh.point(v);
      height += glm::dot(up, glm::dvec3(p.x(), p.y(), p.z()));
      inner = inner && !mesh.is_border(v);
    }
    if (inner && height < least) least = height, lowest = f;
  }
  if (lowest.is_valid()) CGAL::Euler::remove_face(mesh.halfedge(lowest), mesh);
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
  SMS::edge_collapse(mesh, Few_enough_faces{faces, before, &part},
                     CGAL::parameters::filter(SMS::Bounded_normal_change_filter<>()));
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
