// The maps of the fur's shape (docs/shells.md, section 8) in the form that the kernels read.
#pragma once
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opencl/geometry.hpp"
#include "kernels/rasterize/params.h"

namespace pelage::shells {

/// Sets the members of `params` that tell the kernels where the arrays of the scene's maps are.
void place_maps(const FrameInput& input, const Geometry& geometry, RasterParams& params);

/// Returns the layer table, and the arrays of the scene's maps after it, at the places of place_maps().
std::vector<float> styled_layer_table(const FrameInput& input, const Geometry& geometry);

}  // namespace pelage::shells
