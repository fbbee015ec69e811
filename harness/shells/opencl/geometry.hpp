// Host arrays of the mesh and its strands, in the layout that the kernels read.
#pragma once
#include <cstdint>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::shells {

/// Arrays of the drawn mesh. The drawn vertices are the vertices of the mesh. If triangles do not share
/// vertices (parts()), each triangle has three drawn vertices of its own instead.
struct Geometry {
  int vertices = 0;            ///< number of vertices with padding (at least one); a multiple of 16
  int triangles = 0;           ///< number of triangles, padded to a multiple of 16
  int strands = 0;             ///< number of strands, padded to a multiple of 16
  std::vector<float> vertex;   ///< VERTEX_COLUMNS columns
  std::vector<float> uv;       ///< u, v per vertex
  std::vector<float> mask_uv;  ///< UV at which each vertex samples the mask: column u, then column v
  std::vector<float> tangent;  ///< RECORD floats per vertex: dX/du, dX/dv and two unused floats
  /// Four values per triangle: three vertex indices, and space for the number of layers in which the triangle
  /// is drawn, which a kernel computes.
  std::vector<std::int32_t> corner;
  std::vector<std::uint32_t> stick;  ///< per vertex, the index of the mass-spring stick that moves it; empty for Silva's strands
  // A sparse matrix of the weights with which strands bend vertices (Silva's model). The row of a vertex has
  // one entry per strand that bends the vertex. Within a block of `lanes` vertices, all rows are padded to
  // the same length.

  /// The index of each block's first entry, divided by `lanes`. There is one more value: the end of the last
  /// block.
  std::vector<std::int32_t> slice;
  std::vector<std::int32_t> strand;
  std::vector<float> weight;
  std::vector<float> strand_constants;  ///< STRAND_COLUMNS columns
};

/// Converts the mesh and the strands of `input` to the layout of Geometry. `lanes` is the number of lanes of
/// the kernels, 1 or 16. Throws InputError for more than 2^28 vertices or triangles. Also throws it if the
/// scene has a mass-spring topology and `input` does not have one stick normal per surface point.
Geometry lay_out(const FrameInput& input, int lanes);

}  // namespace pelage::shells
