// Textures in the layout of kernels/rasterize/shading/textures.clh.
#pragma once
#include <cstdint>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::shells {

/// One word per texel: coverage and shade of (x, y), then of (x, y + 1), a byte each; each row ends with its
/// first texel again. Levels follow each other.
std::vector<std::int32_t> packed_fur(const FurTexture& fur);

/// Two words per texel: red and green of (x, y) and of (x, y + 1), then blue of both; with a border of a
/// texel all around, because the picture repeats.
std::vector<std::int32_t> packed_coat(const CoatTexture& coat);

}  // namespace pelage::shells
