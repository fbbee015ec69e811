// A scene in the kernels' terms.
#pragma once
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opencl/geometry.hpp"
#include "kernels/rasterize/params.h"
#include "kernels/simulate/params.h"

namespace pelage::shells {

SimulateParams simulate_params(const Scene& scene, const Geometry& geometry);

/// (sin, cos) of 2 pi f t at the start of each substep of frame number `frame` (0: from rest).
std::vector<float> gust_table(const DynamicsScene& dynamics, int frame);

/// LAYER_COLUMNS floats per layer: h, cos and sin of omega h, ln h, h^k of B Eq. 4; computed in double,
/// rounded once.
std::vector<float> layer_table(const Scene& scene);

/// Everything but the tiling, which the caller owns.
RasterParams raster_params(const FrameInput& input, const Geometry& geometry);

}  // namespace pelage::shells
