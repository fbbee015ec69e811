// Host arrays of the mesh and its strands, in the layout that the kernels read.
#pragma once
#include <cstdint>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::shells {

/// Arrays of the drawn mesh. The drawn vertices are the vertices of the mesh. If triangles do not share
/// vertices (parts() is true), each triangle has three drawn vertices of its own instead.
struct Geometry {
  int vertices = 0;           ///< number of drawn vertices plus at least one padding vertex; a multiple of 16
  int triangles = 0;          ///< number of triangles, padded to a multiple of 16
  int strands = 0;            ///< number of strands, padded to a multiple of 16
  std::vector<float> vertex;  ///< VERTEX_COLUMNS columns of `vertices` floats (kernels/rasterize/params.h)
  std::vector<float> uv;      ///< u, v per vertex
  /// UV coordinates at which the vertices sample the wetness mask: first u of all vertices, then v of all
  /// vertices. With curl.radius_map, the factors of curl.radius of all vertices follow.
  std::vector<float> mask_uv;
  std::vector<float> turns;  ///< factor of curl.turns of each vertex; empty without curl.turns_map
  /// RECORD floats per vertex: derivatives of the position with respect to u and v, then two unused floats.
  std::vector<float> tangent;
  /// Four values per triangle. The first three values are the indices of its vertices. A kernel writes the
  /// fourth value: the number of layers in which the triangle is drawn.
  std::vector<std::int32_t> corner;
  /// For each drawn vertex except the padding vertices, the index of the mass-spring stick that moves it.
  /// Empty for Silva's strands.
  std::vector<std::uint32_t> stick;
  // The next three arrays store a sparse matrix for Silva's strands. The tip offset of a vertex is the
  // weighted mean of the tip offsets of the strands around the vertex. The matrix has one row per vertex. An
  // entry of the row is the index and the weight of one of these strands. Within a block of `lanes` vertices
  // (see lay_out()), all rows are padded to the same length with entries of weight 0.

  /// For each block of `lanes` vertices, the index of the block's first entry in `strand` and `weight`,
  /// divided by `lanes`. One more value follows: the size of `strand`, divided by `lanes`.
  std::vector<std::int32_t> slice;
  std::vector<std::int32_t> strand;
  std::vector<float> weight;
  /// VIRTUAL_STRAND_COLUMNS columns of `strands` floats. With fur.length_map, one more column holds the
  /// lengths in R. With colliders, three more columns hold the roots.
  std::vector<float> strand_constants;
};

/// Converts the mesh and the strands of `input` to the layout of Geometry. `lanes` is the number of vertices
/// that a work-item computes at once, 1 or 16. Throws InputError if there are more than 2^28 - 16
/// triangles or more than 2^28 - 17 drawn vertices. Also throws InputError if the scene has a mass-spring
/// topology and `input` does not have one stick normal per surface point (Mesh::weld).
Geometry lay_out(const FrameInput& input, int lanes);

}  // namespace pelage::shells
