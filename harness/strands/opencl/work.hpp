// The number of floating-point operations in a frame of strands, computed from numbers of strands and
// fragments.
#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "harness/strands/drawing/drawing.hpp"

namespace pelage::strands {

/// Each constant is the number of floating-point operations of one computation. The comment of the constant
/// names the computation and tells how often it is done. An fma counts as two operations. A division, a
/// square root, a reciprocal or a rounding to an integer counts as one operation. Comparisons, selections and
/// conversions are not counted. tests/strands/opencl/work_test.cpp checks the numbers up to `shadow`
/// against the kernels' source. The numbers after it were counted in the source, because the functions need
/// several lanes.
namespace operations {
/// One time step of a chain that touches no stop. Per key strand and substep.
inline constexpr double chain_step = 665;
/// Interpolation of a strand between three key strands, control points, projection and culling. Per strand.
inline constexpr double between_keys = 275;
/// Response, twist and curvature. Per strand, if a strand has another value than the default.
inline constexpr double style = 150;
/// Fill lights, rim light, and the heights of a strand above the skin. Per drawn strand, if
/// StrandWork::lights is true.
inline constexpr double steady_light = 161;
/// A vertex of a strip without these lights, a vertex with these lights, and the operations that a shadow
/// adds. Per vertex.
inline constexpr double vertex = 161, lit_vertex = 196, shadow = 186;
/// A vertex of a strip in the opacity map. Per vertex.
inline constexpr double map_vertex = 42;
/// A vertex of the skin without lights and shadow. Per vertex.
inline constexpr double skin_vertex = 50;
/// Direction, joints and rows of a segment (kernels/strands/draw/segments.clh). Per segment.
inline constexpr double segment = 71;
/// Position along and across a segment, coverage, colours and blending (kernels/strands/draw/tile.cl). Per
/// fragment.
inline constexpr double fragment = 38;
/// Barycentric coordinates, depth and colour of a pixel of the skin (kernels/strands/draw/skin.cl). Per pixel
/// that shows the skin, in each of the kernels skin_depth, skin_owner and skin_colours.
inline constexpr double skin_pixel = 30;
}  // namespace operations

/// What a frame consists of.
struct StrandWork {
  std::size_t keys = 0;        ///< key strands
  int substeps = 0;            ///< time steps per frame
  std::size_t strands = 0;     ///< strands that are interpolated
  std::size_t drawn = 0;       ///< strands in the picture
  std::size_t listed = 0;      ///< strands in the lists of the picture's tiles
  std::size_t map_listed = 0;  ///< strands in the lists of the opacity map's tiles
  double fragments = 0;        ///< fragments of the picture with a coverage above 0, also hidden ones
  std::size_t skin_vertices = 0, skin_pixels = 0;
  bool styles = false, lights = false, shadow = false;
  int segments = 0;  ///< segments per strand
};

/// Name of a phase and name of a kernel.
using PhaseKernel = std::pair<std::string, std::string>;

/// Returns the number of floating-point operations of each kernel in one frame. Kernels that only sort, count
/// or copy are absent. The fragments of the opacity map are not counted, because their number is not known;
/// the number of its strand_tiles contains the vertices and the segments.
std::map<PhaseKernel, double> frame_operations(const StrandWork& work);

}  // namespace pelage::strands
