// Textures in the layout of kernels/rasterize/shading/textures.clh.
#pragma once
#include <cstdint>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::shells {

/// Packs the fur into one 32-bit word per texel. The bytes of a word, lowest first, are coverage and shade of
/// (x, y), then coverage and shade of (x, y + 1). The first texel of a row is repeated at its end. Mip levels
/// follow each other.
std::vector<std::int32_t> packed_fur(const FurTexture& fur);

/// Packs the coat into two 32-bit words per texel. The first holds red and green of (x, y), then red and
/// green of (x, y + 1). The second holds blue of both texels in bytes 0 and 2. A border of one texel repeats
/// the texels of the opposite side, because the texture repeats.
std::vector<std::int32_t> packed_coat(const CoatTexture& coat);

}  // namespace pelage::shells
