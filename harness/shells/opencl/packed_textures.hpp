// Packs textures into the layout that kernels/rasterize/shading/textures.clh reads, and the maps of the fur's
// shape (docs/shells.md, section 8) into the table of the layers.
#pragma once
#include <cstdint>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opencl/geometry.hpp"
#include "kernels/rasterize/params.h"

namespace pelage::shells {

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
