// Tangent vectors of the surface: the derivatives of the position by UV, and the frame of the curl.
#pragma once
#include "harness/prepare/frame_input.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage {

/// The derivatives dX/du and dX/dv per vertex, R per UV unit: the mean over the triangles of the vertex,
/// weighted by UV area. The weights limit the influence of triangles that are small in UV, whose derivatives
/// are large. If all triangles of a vertex have zero UV area, its tangents have the lengths in
/// mesh.length_per_uv.
SurfaceTangents surface_tangents(const Mesh& mesh, const Skin& skin);

/// The vectors u and v of S Eq. 4 per surface point, orthonormal and tangential. With curl.frame "uv", u is
/// the direction of dX/du of the first vertex, as printed in the paper; it is discontinuous at UV seams. With
/// "smooth", u is the mean direction of dX/du of the point's vertices, smoothed over the surface. Then both
/// are rotated by a smooth random angle of up to `variation` turns, which varies the phase of the curls.
CurlFrame curl_frame(const Mesh& mesh, const Skin& skin, const SurfaceTangents& tangents,
                     const CurlScene& curl);

}  // namespace pelage
