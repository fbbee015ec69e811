// The number of floating-point operations in a frame, computed from its fragment counts.
#pragma once
#include <map>
#include <string>

#include "harness/shells/opencl/params.hpp"
#include "harness/shells/opencl/shells.hpp"

namespace pelage::shells {

/// Each constant is the number of floating-point operations of one computation. The comment of the constant
/// names the computation and tells how often it is done. Shaded and blended fragments are defined in Tally.
/// An fma counts as two operations. A division, a square root or a rounding to an integer counts as one.
/// Comparisons, selections and conversions are not counted. tests/shells/opencl/work_test.cpp checks these
/// numbers against the kernels' source. Coverage and texture addresses are computed in integers and not
/// counted. The blending of two rows of texels is also computed in integers. It counts as three operations,
/// because floats would need two products and a sum.
namespace operations {
/// Computes S Eq. 2 and 3. Once per strand and substep.
inline constexpr double strand_substep = 89;
/// Adds one strand's tip to the weighted mean of the tips at a vertex. Once per vertex and adjacent strand.
inline constexpr double tip_entry = 6;
/// Computes S Eq. 1, S Eq. 4 and the projection to the screen. Once per vertex and layer.
inline constexpr double vertex_layer = 53;
/// Computes depth and barycentric coordinates. Once per shaded fragment.
inline constexpr double point = 17;
/// Interpolates eight attributes over a triangle. One to three times per shaded fragment.
inline constexpr double record = 48;
/// Computes the view direction. Once per pixel or per shaded fragment (MappingKind::one_eye_per_pixel).
inline constexpr double eye = 22;
/// Computes the squared length of the normal. Once per shaded fragment.
inline constexpr double square = 5;
/// Computes the mip level and samples the fur texture in two mip levels. Once per shaded fragment.
inline constexpr double dry_fragment = 107;
/// Computes S Algorithm 2. Once per wet shaded fragment.
inline constexpr double clump = 24;
/// Computes the UV shift between two sub-steps. Once per shaded fragment if fur.substeps > 1.
inline constexpr double substeps = 98;
/// Samples the fur texture in one more sub-step. fur.substeps - 1 times per shaded fragment.
inline constexpr double substep = 70;
/// Computes the coat's colour, the tangent, the self-shadow and two highlights with exponent 24. Once per
/// blended fragment with the curling model.
inline constexpr double colour = 113;
/// Computes the other terms of S Eq. 6 for one light. Once per light and blended fragment.
inline constexpr double light = 35;
/// Computes W Eq. 2 to 5, except the terms in wet_light. It replaces `colour` if surface_light is 1.
inline constexpr double wet_colour = 122;
/// Computes the terms of W Eq. 2 for one light. It replaces `light` if surface_light is 1.
inline constexpr double wet_light = 40;
/// Blends a fragment with the picture. Once per blended fragment.
inline constexpr double blend = 8;
}  // namespace operations

/// Returns the number of floating-point operations of each kernel in one frame, by kernel name. `tally` has
/// the frame's fragment counts. `wet_share` is the wet fraction of the surface, 0 to 1. The function assumes
/// that `wet_share` is also the wet fraction of the shaded fragments.
std::map<std::string, double> frame_operations(const RasterParams& raster, const SimulateParams& simulate,
                                               const Geometry& geometry, const Tally& tally,
                                               double wet_share);

}  // namespace pelage::shells
