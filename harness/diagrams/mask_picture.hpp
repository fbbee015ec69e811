// The wetness mask as a picture, with the triangles of the UV map over it, as in the insets of S Fig. 5, 11
// and 12 and W Fig. 1, 3 and 6 (docs/experiments.md), and the textures of the fur, as in S Fig. 3.
#pragma once
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::diagrams {

/// Edges of triangles are drawn only if their mean length is at least this number of pixels.
inline constexpr double least_edge = 6.0;

/// Returns the colour of a mask texel. `clump` is the centre (c_u, c_v) of the texel's clump, its radius and
/// its wetness rho. Dry texels (rho = 0) are black. The colour of a wet texel is proportional to rho. Its hue
/// depends only on the centre, so that neighbouring clumps have different blues.
glm::vec3 clump_colour(const glm::vec4& clump);

/// Draws the mask into a picture of side x side pixels; the top row is at v = 1. `mask` has wetness.size^2
/// texels, and its first row is at v = 0. A texel is (c_u, c_v, radius, wetness). A pixel has the colour of
/// the mask's lookup at its centre (docs/shells.md, section 2), and is grey outside the UV map. Over it, the
/// borders and seams of the UV map are drawn in white and the edges of its triangles in a weaker white; the
/// edges are left out if they would be shorter than least_edge on average.
Picture mask_picture(const FrameInput& input, const std::vector<glm::vec4>& mask, int side);

/// Returns the coat's texture, one pixel per texel; the top row is at v = 1.
Picture coat_picture(const CoatTexture& coat);

/// Returns four slices of the fur's texture side by side, with a grey line of 8 pixels between them: those of
/// the layers floor(N (2 i + 1) / 8), i = 0..3. A slice shows the 64 x 64 texels from (u, v) = 0 on (the
/// whole slice if it is smaller) on 256 x 256 pixels. The value of a pixel is the square root of the coverage
/// times the strand's shade, divided by the greatest value of the four slices. v increases upwards.
Picture slices_picture(const FurTexture& fur);

}  // namespace pelage::diagrams
