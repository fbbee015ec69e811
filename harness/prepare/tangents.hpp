// Tangent vectors of the surface: the derivatives of the position with respect to UV, and the tangent frame
// of the curl. S is a paper that docs/frame.md lists.
#pragma once
#include "harness/prepare/frame_input.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage {

/// Returns the derivatives dX/du and dX/dv at each vertex, in R per unit of UV. They are means over the
/// triangles of the vertex, weighted by UV area. The weights limit the influence of triangles that are small
/// in UV, whose derivatives are large. If all triangles at a vertex have zero UV area, the directions of
/// dX/du and dX/dv are arbitrary, and their lengths are taken from mesh.length_per_uv.
SurfaceTangents surface_tangents(const Mesh& mesh, const Skin& skin);

/// Returns the vectors u and v of S Eq. 4 for each surface point, orthonormal and tangential. With curl.frame
/// "uv", u is the direction of dX/du at the point's first vertex, as in S; this direction is discontinuous at
/// UV seams. With "smooth", u is the mean direction of dX/du of the point's vertices, smoothed over the
/// surface. Then u and v are rotated by a random angle of up to curl.variation turns. The angle varies
/// smoothly over the surface, and it changes the phase of the curls.
CurlFrame curl_frame(const Mesh& mesh, const Skin& skin, const SurfaceTangents& tangents,
                     const CurlScene& curl);

}  // namespace pelage
