// Directions on the surface: the atlas's own, and the frame in which strands curl.
#pragma once
#include "harness/prepare/frame_input.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage {

/// dX/du and dX/dv per vertex copy, R per UV unit: the mean over the copy's faces, weighted by their UV area,
/// so that faces squeezed in the atlas do not shout. A copy all of whose faces are flat in UV gets the mean
/// scale.
SurfaceTangents surface_tangents(const Mesh& mesh, const Skin& skin);

/// S Eq. 4's u and v per surface point, orthonormal and tangential. "uv": the first copy's UV gradient, as
/// printed; it jumps where the atlas is cut. "smooth": the mean of the copies' gradients, smoothed over the
/// welded surface and turned by a smooth random angle of `variation` turns, so that curls are not all in
/// phase.
CurlFrame curl_frame(const Mesh& mesh, const Skin& skin, const SurfaceTangents& tangents,
                     const CurlScene& curl);

}  // namespace pelage
