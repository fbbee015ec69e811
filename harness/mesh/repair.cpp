#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "harness/error.hpp"
#include "harness/mesh/cgal_mesh.hpp"
#include "harness/mesh/steps.hpp"

namespace PMP = CGAL::Polygon_mesh_processing;

namespace pelage {
namespace {

using Notes = std::vector<std::string>;

// Adds a note of what was done to how many items, unless there are none.
void note(Notes& notes, std::string_view done, std::size_t count, std::string_view one, std::string_view many,
          std::string_view rest = "") {
  if (count > 0) notes.push_back(fmt::format("{} {} {}{}", done, count, count == 1 ? one : many, rest));
}

Polyhedron from_soup(const Soup& soup, Notes& notes, const std::string& name, Stages& stages) {
  std::vector<Kernel::Point_3> points;
  points.reserve(soup.point.size());
  for (const glm::dvec3& p : soup.point) points.emplace_back(p.x, p.y, p.z);
  std::vector<std::vector<std::size_t>> polygons;
  polygons.reserve(soup.polygon.size());
  for (const auto& polygon : soup.polygon) polygons.emplace_back(polygon.begin(), polygon.end());

  stages.begin("welding points");
  const std::size_t welded = PMP::merge_duplicate_points_in_polygon_soup(points, polygons);
  note(notes, "welded", welded, "coincident point", "coincident points");
  const std::size_t before = polygons.size();
  stages.begin("dropping degenerate faces");
  PMP::repair_polygon_soup(points, polygons);
  // There may be more polygons than before, because CGAL divides those that touch themselves.
  note(notes, "dropped", before - std::min(before, polygons.size()), "degenerate or doubled face",
       "degenerate or doubled faces");
  if (polygons.empty()) throw InputError(fmt::format("{}: no face with an area is left", name));
  const std::size_t joined = points.size();
  stages.begin("orienting faces");
  PMP::orient_polygon_soup(points, polygons);
  note(notes, "split", points.size() - joined, "point", "points",
       " shared by faces of inconsistent orientation");
  stages.begin("joining faces");
  Polyhedron mesh;
  PMP::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  if (!CGAL::is_triangle_mesh(mesh)) {
    PMP::triangulate_faces(mesh);
    notes.push_back("divided polygons into triangles");
  }
  return mesh;
}

void keep_largest_piece(Polyhedron& mesh, Notes& notes) {
  const auto faces = mesh.number_of_faces();
  auto piece = mesh.add_property_map<Polyhedron::Face_index, std::size_t>("f:piece").first;
  const std::size_t pieces = PMP::connected_components(mesh, piece);
  if (pieces > 1) {
    PMP::keep_largest_connected_components(mesh, 1);
    mesh.collect_garbage();
    notes.push_back(fmt::format("kept the largest of {} components, {} of {} faces", pieces,
                                mesh.number_of_faces(), faces));
  }
  mesh.remove_property_map(piece);
}

// Keeps all closed components. Keeps an open component if its area is at least 1% of the area of the largest
// component. Throws InputError if more than 1000 components remain.
void drop_scraps(Polyhedron& mesh, Notes& notes, const std::string& name) {
  constexpr double least = 0.01;
  constexpr std::size_t most_components = 1000;
  auto piece = mesh.add_property_map<Polyhedron::Face_index, std::size_t>("f:piece").first;
  const std::size_t pieces = PMP::connected_components(mesh, piece);
  std::vector<double> area(pieces, 0);
  std::vector<char> open(pieces, false);
  for (const auto f : mesh.faces()) area[piece[f]] += CGAL::to_double(PMP::face_area(f, mesh));
  for (const auto h : mesh.halfedges())
    if (mesh.is_border(h)) open[piece[mesh.face(mesh.opposite(h))]] = true;
  const double largest = *std::max_element(area.begin(), area.end());
  std::vector<std::size_t> kept;
  for (std::size_t n = 0; n < pieces; ++n)
    if (!open[n] || area[n] >= least * largest) kept.push_back(n);
  if (kept.size() > most_components)
    throw InputError(fmt::format(
        "{}: {} components; at most {} components can have their own chart of the UV map; keep only the largest (mesh.components, --components largest), or join them",
        name, kept.size(), most_components));
  if (kept.size() < pieces) {
    PMP::keep_connected_components(mesh, kept, piece);
    notes.push_back(
        fmt::format("kept {} of {} components; the others are open and small", kept.size(), pieces));
  }
  mesh.remove_property_map(piece);
  mesh.collect_garbage();
}

void drop_degenerate_faces(Polyhedron& mesh, Notes& notes) {
  std::vector<Polyhedron::Face_index> flat;
  PMP::degenerate_faces(mesh, std::back_inserter(flat));
  if (flat.empty()) return;
  const bool all = PMP::remove_degenerate_faces(mesh);
  mesh.collect_garbage();
  note(notes, "removed", flat.size(), "face", "faces", all ? " without area" : " without area, not all");
}

double width(const Polyhedron& mesh, Polyhedron::Halfedge_index border) {
  CGAL::Bbox_3 box;
  for (const auto h : CGAL::halfedges_around_face(border, mesh)) box += mesh.point(mesh.target(h)).bbox();
  return std::hypot(box.x_span(), box.y_span(), box.z_span());
}

void fill_holes(Polyhedron& mesh, bool all, Notes& notes) {
  CGAL::Bbox_3 box;
  for (const auto v : mesh.vertices()) box += mesh.point(v).bbox();
  const double widest = all ? HUGE_VAL : 0.1 * std::hypot(box.x_span(), box.y_span(), box.z_span());
  std::vector<Polyhedron::Halfedge_index> borders;
  PMP::extract_boundary_cycles(mesh, std::back_inserter(borders));
  std::size_t filled = 0;
  for (const auto border : borders) {
    if (width(mesh, border) > widest) continue;
    std::vector<Polyhedron::Face_index> patch;
    PMP::triangulate_hole(mesh, border, std::back_inserter(patch));
    if (!patch.empty()) ++filled;
  }
  note(notes, "filled", filled, "hole", "holes");
  note(notes, "left", borders.size() - filled, "border", "borders", " open");
}

}  // namespace

std::vector<std::array<std::size_t, 3>> triangles_of(const std::vector<glm::dvec3>& corner) {
  if (corner.size() < 3) return {};
  if (corner.size() == 3) return {{0, 1, 2}};
  std::vector<Kernel::Point_3> points;
  points.reserve(corner.size());
  for (const glm::dvec3& p : corner) points.emplace_back(p.x, p.y, p.z);
  std::vector<CGAL::Triple<int, int, int>> found;
  PMP::triangulate_hole_polyline(points, std::back_inserter(found));
  std::vector<std::array<std::size_t, 3>> triangles;
  for (const auto& [a, b, c] : found) {
    triangles.push_back({std::size_t(a), std::size_t(b), std::size_t(c)});
    std::ranges::sort(triangles.back());  // the order of the polygon
  }
  for (std::size_t k = 1; found.empty() && k + 1 < corner.size(); ++k) triangles.push_back({0, k, k + 1});
  std::ranges::sort(triangles);
  return triangles;
}

void orient(Surface& surface) {
  std::vector<Kernel::Point_3> points;
  points.reserve(surface.point.size());
  for (const glm::dvec3& p : surface.point) points.emplace_back(p.x, p.y, p.z);
  std::vector<std::vector<std::size_t>> polygons;
  polygons.reserve(surface.triangle.size());
  for (const auto& t : surface.triangle) polygons.emplace_back(t.begin(), t.end());
  PMP::orient_polygon_soup(points, polygons);
  const std::size_t before = surface.point.size();
  for (std::size_t i = before; i < points.size(); ++i)
    surface.point.emplace_back(points[i].x(), points[i].y(), points[i].z());
  std::size_t turned = 0;
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    const Surface::Triangle was = surface.triangle[f];
    const Surface::Corners uv = surface.uv[f];
    // The corner of the old triangle to which each new one belongs: a point that was split has a new number,
    // but its old place. The first corner stays the first.
    std::array<std::size_t, 3> from{};
    for (std::size_t k = 0; k < 3; ++k)
      while (from[k] < 2 && surface.point[was[from[k]]] != surface.point[polygons[f][k]]) ++from[k];
    const auto first = std::size_t(std::ranges::find(from, 0u) - from.begin()) % 3;
    for (std::size_t k = 0; k < 3; ++k) {
      surface.triangle[f][k] = std::uint32_t(polygons[f][(first + k) % 3]);
      surface.uv[f][k] = uv[from[(first + k) % 3]];
    }
    turned += from[(first + 1) % 3] == 2;
  }
  note(surface.notes, "turned", turned, "face", "faces", " to agree with the neighbours");
  note(surface.notes, "split", points.size() - before, "point", "points",
       " shared by faces of inconsistent orientation");
}

Surface repair(const Soup& soup, const RepairOptions& options, const std::string& name, Stages& stages) {
  Notes notes;
  Polyhedron mesh = from_soup(soup, notes, name, stages);
  stages.begin("stitching borders");
  const std::size_t stitched = PMP::stitch_borders(mesh);
  note(notes, "stitched", stitched, "pair", "pairs", " of border edges");
  const std::size_t split = PMP::duplicate_non_manifold_vertices(mesh);
  note(notes, "split", split, "non-manifold point", "non-manifold points");
  drop_degenerate_faces(mesh, notes);
  if (mesh.number_of_faces() == 0) throw InputError(fmt::format("{}: no face is left after repair", name));
  if (options.largest_only)
    keep_largest_piece(mesh, notes);
  else
    drop_scraps(mesh, notes, name);
  stages.begin("filling holes");
  fill_holes(mesh, options.fill_all, notes);
  PMP::remove_isolated_vertices(mesh);
  mesh.collect_garbage();
  if (options.largest_only && CGAL::is_closed(mesh) && !PMP::is_outward_oriented(mesh)) {
    PMP::reverse_face_orientations(mesh);
    notes.push_back("turned all faces outwards");
  }
  Surface surface = from_cgal(mesh);
  surface.notes = notes;
  if (!options.largest_only) turn_outwards(surface);
  return surface;
}

}  // namespace pelage
