// Kernel parameters and tables, computed from a scene. S is Silva et al. 2010, Curling and Clumping Fur. B is
// Banisch and Wuethrich 2006.
#pragma once
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opencl/geometry.hpp"
#include "kernels/rasterize/params.h"
#include "kernels/simulate/params.h"

namespace pelage::shells {

SimulateParams simulate_params(const Scene& scene, const Geometry& geometry);

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

}  // namespace pelage::shells
