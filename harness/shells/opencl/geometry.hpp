// The mesh and its strands in the layout of the kernels: columns of 16-padded vertices, rows of strand
// weights.
#pragma once
#include <cstdint>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::shells {

/// Vertices of the drawn mesh: the mesh's copies, or three corners per triangle where layers part (parts()).
struct Geometry {
  int vertices = 0;            ///< columns' length: a multiple of 16 and at least one more than there are
  int triangles = 0;           ///< columns' length: a multiple of 16; the last ones may be empty
  int strands = 0;             ///< columns' length of the strand arrays: F rounded up to a multiple of 16
  std::vector<float> vertex;   ///< VERTEX_COLUMNS columns
  std::vector<float> uv;       ///< u, v per vertex
  std::vector<float> mask_uv;  ///< two columns: where the vertex samples the wetness mask
  std::vector<float> tangent;  ///< RECORD floats per vertex: dX/du, dX/dv, two unused
  std::vector<std::int32_t> corner;  ///< four per triangle: its vertices and 0
  std::vector<std::uint32_t> stick;  ///< per vertex but for the padding: a topology's stick; else empty
  // Which of Silva's strands bend a vertex, padded per block of `lanes` vertices.
  std::vector<std::int32_t> slice;  ///< blocks + 1
  std::vector<std::int32_t> strand;
  std::vector<float> weight;
  std::vector<float> strand_constants;  ///< STRAND_COLUMNS columns
};

/// `lanes`: 1 or 16, as the kernels are built.
Geometry lay_out(const FrameInput& input, int lanes);

}  // namespace pelage::shells
