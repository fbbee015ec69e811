// The textures of the fur as pictures, as in S Fig. 3: the coat's colour and slices of the fur's volume
// texture.
#pragma once
#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::diagrams {

/// Returns the coat's texture, one pixel per texel; the top row is at v = 1.
Picture coat_picture(const CoatTexture& coat);

/// Returns four slices of the fur's texture side by side, with a grey line of 8 pixels between them: those of
/// the layers floor(N (2 i + 1) / 8), i = 0..3. A slice shows the 64 x 64 texels from (u, v) = 0 on (the
/// whole slice if it is smaller) on 256 x 256 pixels. The value of a pixel is the square root of the coverage
/// times the strand's shade, divided by the greatest value of the four slices. v increases upwards.
Picture slices_picture(const FurTexture& fur);

}  // namespace pelage::diagrams
