// Measures of a prepared mesh: counts, topology, and quality of the UV map.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "harness/mesh/mesh.hpp"

namespace pelage {

struct Topology {
  std::size_t copies;  ///< number of vertices; a surface point on a UV seam has several vertices
  std::size_t points;  ///< number of surface points
  std::size_t edges;   ///< number of edges between surface points
  std::size_t faces;
  std::size_t boundary_edges;
  std::size_t borders;  ///< number of closed loops of boundary edges
  std::size_t components;
  long genus;  ///< number of handles, summed over all components; valid only for a manifold
  /// Number of edges that have more than two faces, or two faces that are oriented inconsistently.
  std::size_t bad_edges;
  std::size_t bad_points;  ///< number of points whose faces do not form a single fan
  bool manifold() const { return bad_edges == 0 && bad_points == 0; }
};

Topology topology(const Mesh& mesh);

struct UvQuality {
  std::size_t charts;
  std::size_t flipped_faces;
  double flipped;      ///< UV area of the flipped faces, as a fraction of the UV area of all faces
  double overlapping;  ///< texels covered by several faces, as a fraction of all covered texels
  double covered;      ///< fraction of the unit square that is covered by faces
  /// The 1st, 50th and 99th percentile of the faces' area scales, weighted by surface area. The area scale of
  /// a face is its ratio of UV area to surface area, divided by the same ratio of the whole map. A face with
  /// the area scale 1 is neither enlarged nor reduced relative to the whole map. The number of strands per
  /// surface area is proportional to the area scale, because the fur texture lies in UV.
  double area_low, area_median, area_high;
  double area_5, area_95;  ///< the 5th and the 95th percentile
};

/// Measures the UV map. Coverage and overlap are counted at the centres of `side` x `side` texels.
UvQuality uv_quality(const Mesh& mesh, int side = 2048);

/// Returns warnings about the UV map, one line each. One warning reports flipped faces. The other warning
/// reports overlap: several faces cover at least 0.01% of the covered texels of a grid of 2048 x 2048 texels.
std::vector<std::string> uv_warnings(const Mesh& mesh);

/// Returns the notes of a mesh file, and then its uv_warnings().
std::vector<std::string> mesh_warnings(const Mesh& mesh);

/// Returns the chart number of each face. Charts are numbered from 0 in the order of their first faces. Two
/// faces that share an edge belong to the same chart if they have the same vertices, and therefore the same
/// UV, at both ends of the edge.
std::vector<std::uint32_t> charts(const Mesh& mesh);

}  // namespace pelage
