// The shape of the fur as a function of the position on the surface (docs/shells.md, section 8). Pictures in
// UV space, the maps, multiply the scene's values of length, curl, density and comb.
#pragma once
#include "harness/prepare/frame_input.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage {

/// Least factor of the length. The normal of the surface is computed from the strands, so no strand may have
/// the length 0.
inline constexpr float least_length_share = 1.0f / 256.0f;

/// Reads the maps of a scene. The arrays of maps that the scene does not name stay empty. Throws InputError
/// with the scene key and the file if a picture cannot be read, or if a pixel's luma is not from 0 to 1.
Style make_style(const Mesh& mesh, const Skin& skin, const Scene& scene);

/// Returns the length of a strand in R: fur.length times its factor, in single precision.
float strand_length(const FurScene& fur, const Style& style, std::size_t strand);

/// Returns the greatest radius of a curl in R: curl.radius times the greatest factor.
float most_curl_radius(const CurlScene& curl, const Style& style);

}  // namespace pelage
