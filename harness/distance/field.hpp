// The distance from a closed mesh, and the body as a coarse signed distance field: a grid with the distance
// from the surface at each node.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/mesh/search.hpp"

namespace pelage {

/// Distances in R at the nodes of a regular grid, below 0 inside the body. docs/strands.md, section Body,
/// defines the values between the nodes.
struct DistanceField {
  std::string mesh;             ///< Mesh::hash
  glm::ivec3 nodes{0};          ///< number of nodes along each axis, at least 2
  glm::vec3 origin{0};          ///< position of node (0, 0, 0), R
  float cell = 0;               ///< distance between adjacent nodes, R
  std::vector<float> distance;  ///< index of node (x, y, z): x + nodes.x (y + nodes.y z)
};

/// Returns the distance field of a closed mesh. `cells` is the number of cells along the longest side of the
/// mesh's bounding box, 4 to 256. The grid extends at least 2 cells beyond the bounding box on all sides.
/// Throws InputError if the mesh is not closed, or if `cells` is out of range.
DistanceField distance_field(const std::shared_ptr<const Mesh>& mesh, int cells = 64);

/// Returns the grid of the field of a mesh, without distances. If the mesh has frames, the grid surrounds all
/// of them. Throws InputError if `cells` is out of range.
DistanceField grid_of(const Mesh& mesh, int cells);

/// Returns the field of distance_field() from the cache on disk (subfolder `fields` of cache_folder()), or
/// computes the field and writes it to the cache.
std::shared_ptr<const DistanceField> kept_distance_field(const std::shared_ptr<const Mesh>& mesh,
                                                         int cells = 64);

/// Returns the field of each of the mesh's frames (Mesh::frames), from the cache on disk like
/// kept_distance_field(). All have the grid of grid_of().
std::vector<std::shared_ptr<const DistanceField>> kept_distance_fields(
    const std::shared_ptr<const Mesh>& mesh, int cells);

/// Returns the field's value at a point (trilinear interpolation), R. A point outside the grid has the value
/// of the nearest point of the grid.
double value_at(const DistanceField& field, glm::dvec3 point);

/// Largest number of edges of a hole that is_closed() permits.
inline constexpr std::size_t small_hole = 16;

/// Returns whether the triangles divide space into inside and outside: they use each edge equally often in
/// both directions. Vertices at the same surface point count as one. Small holes, with at most small_hole
/// edges, are permitted.
bool is_closed(const Mesh& mesh);

/// Finds out where the inside is. Triangles from its edges to its centre close a small hole. distance()
/// measures the distance from the triangles of the mesh only.
class ClosedSurface {
 public:
  /// Throws InputError if the mesh is not closed.
  explicit ClosedSurface(const std::shared_ptr<const Mesh>& mesh);

  /// Returns how often the surface winds around the point: 0 outside. It is the number of triangles that the
  /// ray from the point along +x leaves through, minus the number of triangles through which it enters.
  int winding(glm::dvec3 point) const;

  /// Returns the distance from the surface in R, below 0 if the winding number is above 0.
  double distance(glm::vec3 point) const;

 private:
  std::size_t bin_of(glm::dvec2 point) const;

  std::vector<std::array<glm::dvec3, 3>> triangles_;
  SurfaceSearch search_;
  // The square that contains the projections (y, z) of all points is divided into side_ x side_ bins. The
  // triangles of bin i are member_[row_[i]] .. member_[row_[i + 1] - 1].
  int side_ = 1;
  glm::dvec2 least_{0}, per_bin_{1};
  std::vector<std::uint32_t> row_, member_;
};

}  // namespace pelage
