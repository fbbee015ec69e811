// What a frame computes, counted: fragments by the device, floating-point operations from them.
#pragma once
#include <map>
#include <string>

#include "harness/shells/opencl/params.hpp"
#include "harness/shells/opencl/shells.hpp"

namespace pelage::shells {

/// Floating-point operations per item, an fma counted as two, a division, square root or power of two as one,
/// a comparison, a choice or a conversion as none. tests/shells/opencl/work_test.cpp counts them in the
/// kernels' own text. Coverage and texture addresses are integers: no operation of theirs is in here. That
/// two rows of texels are blended in integers changes nothing: two products and a sum.
namespace operations {
inline constexpr double strand_substep = 89;  ///< S Eq. 2 and 3
inline constexpr double tip_entry = 6;        ///< one strand's share in a vertex
inline constexpr double vertex_layer = 53;    ///< S Eq. 1 and 4 and the projection, per vertex and layer
inline constexpr double point = 17;           ///< depth and barycentrics at a pixel
inline constexpr double record = 48;          ///< eight attributes over a triangle
inline constexpr double eye = 22;             ///< from the eye through a pixel
inline constexpr double square = 5;           ///< the normal's
inline constexpr double dry_fragment = 107;   ///< level of detail and fur, two mip levels
inline constexpr double clump = 24;           ///< more where it is wet: Algorithm 2
inline constexpr double substeps = 98;        ///< more where there are sub-steps: the ray's shift
inline constexpr double substep = 70;         ///< and per further sub-step
inline constexpr double colour = 113;         ///< coat, tangent, shadow, two highlights of exponent 24
inline constexpr double light = 35;           ///< the rest of S Eq. 6, per light
inline constexpr double wet_colour = 122;     ///< W Eq. 2 to 5 instead
inline constexpr double wet_light = 40;
inline constexpr double blend = 8;
}  // namespace operations

/// Per kernel of a frame that has any; `wet_share` of the surface, 0 to 1, stands for that of the fragments.
std::map<std::string, double> frame_operations(const RasterParams& raster, const SimulateParams& simulate,
                                               const Geometry& geometry, const Tally& tally,
                                               double wet_share);

}  // namespace pelage::shells
