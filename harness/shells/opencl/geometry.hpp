// Host arrays of the mesh and its strands, in the layout that the kernels read.
#pragma once
#include <cstdint>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::shells {

/// Arrays of the drawn mesh. Its vertices are the mesh's vertex copies, or three corners per triangle if
/// triangles do not share vertices (parts()).
struct Geometry {
  int vertices = 0;                  ///< number of vertices, padded to a multiple of 16 by at least one
  int triangles = 0;                 ///< number of triangles, padded to a multiple of 16
  int strands = 0;                   ///< number of strands, padded to a multiple of 16
  std::vector<float> vertex;         ///< VERTEX_COLUMNS columns
  std::vector<float> uv;             ///< u, v per vertex
  std::vector<float> mask_uv;        ///< columns u and v: the UV at which a vertex samples the mask
  std::vector<float> tangent;        ///< RECORD floats per vertex: dX/du, dX/dv and two unused floats
  std::vector<std::int32_t> corner;  ///< four per triangle: three vertex indices and room for its reach
  std::vector<std::uint32_t> stick;  ///< stick of each vertex, without padding; empty for Silva's strands
  // The strands that bend each vertex, and their weights (Silva's model). Each vertex has a row of entries.
  // All rows of a block of `lanes` vertices are padded to the same length.
  std::vector<std::int32_t> slice;  ///< start of each block, in units of `lanes` entries; blocks + 1 values
  std::vector<std::int32_t> strand;
  std::vector<float> weight;
  std::vector<float> strand_constants;  ///< STRAND_COLUMNS columns
};

/// Converts the mesh and the strands of `input` to this layout. `lanes` is the number of lanes of the
/// kernels, 1 or 16. Throws InputError for more than 2^28 vertices or triangles, and for a topology without
/// normals.
Geometry lay_out(const FrameInput& input, int lanes);

}  // namespace pelage::shells
