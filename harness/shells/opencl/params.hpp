// Kernel parameters and tables, computed from a scene.
#pragma once
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opencl/geometry.hpp"
#include "kernels/rasterize/params.h"
#include "kernels/simulate/params.h"

namespace pelage::shells {

SimulateParams simulate_params(const Scene& scene, const Geometry& geometry);

/// Returns sin and cos of 2 pi f t at the start time t of each substep of frame number `frame`. f is the
/// gust's frequency. Frame 0 starts at t = 0.
std::vector<float> gust_table(const DynamicsScene& dynamics, int frame);

/// Returns LAYER_COLUMNS floats per layer: the height h of the layer, cos(omega h) and sin(omega h) of S Eq.
/// 4, ln h, and h^k of B Eq. 4. All values are computed in double precision and rounded once to float.
std::vector<float> layer_table(const Scene& scene);

/// Returns the rasterizer's parameters. RasterStage later sets the number of tiles, the number of triangle
/// chunks, and the number of layers per pass.
RasterParams raster_params(const FrameInput& input, const Geometry& geometry);

}  // namespace pelage::shells
