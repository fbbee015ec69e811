// What there is to know about a prepared mesh: counts, topology, and how good its UV map is.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "harness/mesh/mesh.hpp"

namespace pelage {

struct Topology {
  std::size_t copies = 0;  ///< V, vertices with their UV-seam copies
  std::size_t points = 0;  ///< welded
  std::size_t edges = 0;   ///< between welded points
  std::size_t faces = 0;
  std::size_t boundary_edges = 0;
  std::size_t borders = 0;  ///< closed chains of boundary edges
  std::size_t components = 0;
  long genus = 0;              ///< handles, over all components; meaningful for manifolds
  std::size_t bad_edges = 0;   ///< edges of more than two faces, or run through twice in one direction
  std::size_t bad_points = 0;  ///< points whose faces are not one fan
  bool manifold() const { return bad_edges == 0 && bad_points == 0; }
};

Topology topology(const Mesh& mesh);

struct UvQuality {
  std::size_t charts = 0;
  std::size_t flipped_faces = 0;
  double flipped = 0;      ///< UV area of faces turned over, fraction of the map's whole area
  double overlapping = 0;  ///< part of the covered square that more than one face covers
  double covered = 0;      ///< part of the unit square that is covered
  /// UV area over surface area, relative to the whole map's: 1 where nothing is stretched or squeezed. At 1%,
  /// 50% and 99% of the surface's area.
  double area_low = 0, area_median = 0, area_high = 0;
};

/// Overlaps are counted at the centres of `side` x `side` texels.
UvQuality uv_quality(const Mesh& mesh, int side = 2048);

/// What a user of the map must know, a line each: faces turned over, and overlap of at least 0.01% of the
/// covered square at 2048 x 2048 texels. Empty: neither.
std::vector<std::string> uv_warnings(const Mesh& mesh);

/// The chart that each face belongs to, numbered from 0 in face order: faces that share an edge of copies.
std::vector<std::uint32_t> charts(const Mesh& mesh);

}  // namespace pelage
