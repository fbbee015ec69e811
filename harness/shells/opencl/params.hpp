// Kernel parameters and tables, computed from a scene.
#pragma once
#include <cstdint>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opencl/geometry.hpp"
#include "kernels/rasterize/params.h"
#include "kernels/simulate/params.h"

namespace pelage::shells {

SimulateParams simulate_params(const Scene& scene, const Geometry& geometry);

/// Sets the weight and the wind in the parameters of simulate_params().
void set_forces(const DynamicsScene& dynamics, SimulateParams& params);

/// Returns two floats for each substep of frame number `frame`: sin and cos of 2 pi f t, where f is the
/// frequency of the gusts and t is the start time of the substep. Frame 0 starts at t = 0.
std::vector<float> gust_table(const DynamicsScene& dynamics, int frame);

/// Returns LAYER_COLUMNS floats per layer: the height h of the layer (1 at the tips), cos(omega h),
/// sin(omega h), ln h and h^k. omega is the curl's angle per unit of h (S Eq. 4). k is the exponent of the
/// bend of a stick (B Eq. 4). All values are computed in double precision and rounded once to float.
std::vector<float> layer_table(const Scene& scene);

/// Returns the rasterizer's parameters. RasterStage later sets the number of tiles, the number of layers per
/// pass, and the number of chunks into which it divides the triangles.
RasterParams raster_params(const FrameInput& input, const Geometry& geometry);

/// Whether fragments read the axes of the curl: in sub-steps, and for traced shadows.
inline bool shades_curls(const RasterParams& params) {
  return params.substeps > 1 || params.self_shadow == SHADOW_TRACED;
}

/// Packs the fur texture into one 32-bit word per texel. The bytes of a word, lowest first, are coverage and
/// shade of texel (x, y), then coverage and shade of texel (x, y + 1). Each row ends with a copy of its first
/// word. The mip levels are stored one after the other, level 0 first.
std::vector<std::int32_t> packed_fur(const FurTexture& fur);

/// Packs the coat texture into two 32-bit words per texel. The first word holds red and green of texel (x,
/// y), then red and green of texel (x, y + 1). The second word holds blue of both texels in bytes 0 and 2. A
/// border of one texel surrounds the texture. It holds copies of the texels of the opposite side, because the
/// texture repeats.
std::vector<std::int32_t> packed_coat(const CoatTexture& coat);

/// Sets the members of `params` that tell the kernels where the arrays of the scene's maps are.
void place_maps(const FrameInput& input, const Geometry& geometry, RasterParams& params);

/// Returns the layer table, and the arrays of the scene's maps after it, at the places of place_maps().
std::vector<float> styled_layer_table(const FrameInput& input, const Geometry& geometry);

}  // namespace pelage::shells
