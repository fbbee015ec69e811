// The textures of the fur as pictures, as in S Fig. 3: the coat's colour and slices of the fur's volume
// texture.
#pragma once
#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::diagrams {

/// Returns the coat's texture, one pixel per texel; the top row is at v = 1.
Picture coat_picture(const CoatTexture& coat);

/// Returns four slices of the fur's texture side by side, one pixel per texel, with a grey line of 8 pixels
/// between them: those of the layers floor(N (2 i + 1) / 8), i = 0..3. The value of a pixel is the coverage
/// times the strand's shade, divided by the slice's greatest value. The top row of a slice is at v = 1.
Picture slices_picture(const FurTexture& fur);

}  // namespace pelage::diagrams
