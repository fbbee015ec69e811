#include <CGAL/alpha_wrap_3.h>
#include <fmt/format.h>

#include "harness/mesh/cgal_mesh.hpp"
#include "harness/mesh/steps.hpp"

namespace pelage {

Surface wrap(const Surface& surface) {
  const Polyhedron mesh = to_cgal(surface);
  CGAL::Bbox_3 box;
  for (const auto v : mesh.vertices()) box += mesh.point(v).bbox();
  const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
  Polyhedron skin;
  CGAL::alpha_wrap_3(mesh, diagonal / 150, diagonal / 1500, skin);
  Surface wrapped = from_cgal(skin);
  wrapped.notes = surface.notes;
  wrapped.notes.push_back(fmt::format("wrapped {} faces in a watertight skin of {} faces",
                                      surface.triangle.size(), wrapped.triangle.size()));
  return wrapped;
}

}  // namespace pelage
