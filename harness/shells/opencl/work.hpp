// The number of floating-point operations in a frame, computed from its fragment counts.
#pragma once
#include <map>
#include <string>

#include "harness/shells/opencl/params.hpp"
#include "harness/shells/opencl/shells.hpp"

namespace pelage::shells {

/// Each constant is the number of floating-point operations of one computation. The comment of the constant
/// names the computation and tells how often it is done. Shaded and blended fragments are defined in Tally.
/// An fma counts as two operations. A division, a square root or a rounding to an integer counts as one
/// operation. Comparisons, selections and conversions are not counted. tests/shells/opencl/work_test.cpp
/// checks these numbers against the kernels' source. Coverage and texture addresses are computed in integers
/// and not counted. The interpolation between two rows of texels is computed in integers, but it is counted:
/// each interpolated value counts as three operations, because the same interpolation in floating point takes
/// two products and a sum. S is Silva et al. 2010, Curling and Clumping Fur. W is Silva et al. 2010,
/// Real-Time Rendering of Wet Fur.
namespace operations {
/// Operations to simulate one of Silva's strands (S Eq. 2 and 3). They are executed once per strand and
/// substep.
inline constexpr double strand_substep = 89;
/// Operations to add the tip of one strand to the weighted mean of the tips at a vertex. They are executed
/// once per vertex and adjacent strand.
inline constexpr double tip_entry = 6;
/// Operations to compute the position of a vertex on a layer (S Eq. 1 and 4) and to project it to the screen.
/// They are executed once per vertex and layer.
inline constexpr double vertex_layer = 53;
/// Operations to compute depth and barycentric coordinates. They are executed once per shaded fragment.
inline constexpr double point = 17;
/// Operations to interpolate one attribute row of eight floats over a triangle. They are executed once per
/// attribute buffer that the shading reads, that is, one to three times per shaded fragment.
inline constexpr double record = 48;
/// Operations to compute the view direction. They are executed once per pixel if
/// MappingKind::one_eye_per_pixel is true, and once per shaded fragment if it is false.
inline constexpr double eye = 22;
/// Operations to compute the squared length of the normal. They are executed once per shaded fragment.
inline constexpr double square = 5;
/// Operations to compute the mip level and to sample the fur texture in two mip levels. They are executed
/// once per shaded fragment.
inline constexpr double dry_fragment = 107;
/// Operations to compute the clumps of wet fur (S Algorithm 2). They are executed once per shaded fragment
/// whose fur is wet. `consistent_clump` is for clump.cells "consistent", `clump` for the other values.
inline constexpr double clump = 34, consistent_clump = 159;
/// Operations to compute the UV shift between two samples of the fur texture along the view ray. They are
/// executed once per shaded fragment if fur.substeps > 1.
inline constexpr double substeps = 98;
/// Operations to sample the fur texture once more along the view ray. They are executed fur.substeps - 1
/// times per shaded fragment.
inline constexpr double substep = 70;
/// Operations to compute the coat's colour, the tangent, the self-shadow, and the power in each of two
/// highlights (exponent 24). They are executed once per blended fragment if surface_light is 0.
inline constexpr double colour = 113;
/// Operations to compute two values of the curling model (S Eq. 6) for one light: the diffuse term, and the
/// base of the power in the specular term. They are executed once for each pair of a light and a blended
/// fragment.
inline constexpr double light = 35;
/// Operations to compute the lighting of wet fur (W Eq. 2 to 5) without the terms that are counted in
/// wet_light. If the parameter surface_light is 1, this number is used instead of `colour`.
inline constexpr double wet_colour = 122;
/// Operations to compute the terms of one light in the lighting of wet fur (W Eq. 2). If the parameter
/// surface_light is 1, this number is used instead of `light`.
inline constexpr double wet_light = 40;
/// Operations to blend a fragment with the picture. They are executed once per blended fragment.
inline constexpr double blend = 8;
}  // namespace operations

/// Returns the number of floating-point operations of each kernel in one frame, by kernel name. `tally` has
/// the frame's fragment counts. `wet_share` is the wet fraction of the surface, 0 to 1. The function assumes
/// that `wet_share` is also the wet fraction of the shaded fragments.
std::map<std::string, double> frame_operations(const RasterParams& raster, const SimulateParams& simulate,
                                               const Geometry& geometry, const Tally& tally,
                                               double wet_share);

}  // namespace pelage::shells
