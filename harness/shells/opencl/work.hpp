// The number of floating-point operations in a frame, computed from its fragment counts.
#pragma once
#include <map>
#include <string>

#include "harness/shells/opencl/params.hpp"
#include "harness/shells/opencl/shells.hpp"

namespace pelage::shells {

/// Each constant is the number of floating-point operations of one computation, for example per vertex or per
/// fragment. An fma counts as two operations. A division, a square root or a rounding to an integer counts as
/// one. Comparisons, selections and conversions are not counted. tests/shells/opencl/work_test.cpp checks
/// these numbers against the kernels' source. Coverage and texture addresses are computed in integers and not
/// counted. The blending of two rows of texels is also computed in integers. It counts as three operations,
/// because floats would need two products and a sum.
namespace operations {
inline constexpr double strand_substep = 89;  ///< S Eq. 2 and 3
inline constexpr double tip_entry = 6;        ///< weighted mean of strands at a vertex, per strand
inline constexpr double vertex_layer = 53;    ///< S Eq. 1 and 4 and projection, per vertex of a layer
inline constexpr double point = 17;           ///< depth and barycentrics at a pixel
inline constexpr double record = 48;          ///< interpolation of eight attributes
inline constexpr double eye = 22;             ///< view direction of a pixel
inline constexpr double square = 5;           ///< squared length of the normal
inline constexpr double dry_fragment = 107;   ///< mip level, and lookup of the fur in two mip levels
inline constexpr double clump = 24;           ///< S Algorithm 2, only for a wet fragment
inline constexpr double substeps = 98;        ///< UV shift from sample to sample; only if fur.substeps > 1
inline constexpr double substep = 70;         ///< each sub-step after the first
inline constexpr double colour = 113;         ///< coat, tangent, shadow, two highlights with exponent 24
inline constexpr double light = 35;           ///< remaining terms of S Eq. 6, per light
inline constexpr double wet_colour = 122;     ///< W Eq. 2 to 5; replaces `colour` in the wet model
inline constexpr double wet_light = 40;
inline constexpr double blend = 8;
}  // namespace operations

/// Returns the number of floating-point operations of each kernel in one frame, by kernel name. `tally` has
/// the frame's fragment counts. `wet_share` is the wet fraction of the surface, 0 to 1. The function assumes
/// that the same fraction of the fragments is wet.
std::map<std::string, double> frame_operations(const RasterParams& raster, const SimulateParams& simulate,
                                               const Geometry& geometry, const Tally& tally,
                                               double wet_share);

}  // namespace pelage::shells
