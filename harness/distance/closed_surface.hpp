// The exact distance of points from a closed mesh, with a sign that tells inside from outside.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/mesh/search.hpp"

namespace pelage {

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
