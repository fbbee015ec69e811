// Tangent vectors of the surface: the derivatives of the position with respect to UV, and the tangent frame
// of the curl.
#pragma once
#include "harness/prepare/frame_input.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage {

/// Returns the derivatives dX/du and dX/dv at each vertex, in R (the mesh radius) per unit of UV. They are
/// means over the triangles of the vertex, weighted by UV area. The weights limit the influence of triangles
/// that are small in UV, whose derivatives are large. If all triangles at a vertex have zero UV area, the
/// directions of dX/du and dX/dv are arbitrary, and their lengths are taken from mesh.length_per_uv.
SurfaceTangents surface_tangents(const Mesh& mesh, const Skin& skin);

/// Returns two orthonormal tangent vectors for each surface point: u and v of S Eq. 4. With curl.frame "uv",
/// as in S, u is the direction of dX/du at the point's first vertex. This direction is discontinuous at UV
/// seams. With "smooth", u is the mean of the directions of dX/du at the point's vertices. The function
/// smooths these means over the surface, and then rotates u and v by a random angle between -curl.variation
/// and +curl.variation turns. The angle varies smoothly over the surface and changes the phase of the curls.
/// With "uv", u and v are not rotated.
CurlFrame curl_frame(const Mesh& mesh, const Skin& skin, const SurfaceTangents& tangents,
                     const CurlScene& curl);

}  // namespace pelage
