// Computes the strands that move the fur. A strand has a root, a rest position, and one mass on a spring.
// Weights give the influence of the strands on each surface point.
#pragma once
#include "harness/prepare/frame_input.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage {

/// Returns the cosine and the sine of the phase of the wind's gusts at a root (docs/shells.md, section 1).
glm::vec2 gust_phase(const glm::dvec3& root, const WindScene& wind);

/// Returns one strand per triangle (S 3.2.1). L0 is the length of the fur, n is the normal of the triangle,
/// and the tangent vector a is the tilt of the strand. The vector from the root to the tip at rest is L0
/// normalize(n + a). The key fur.comb tilts the strands towards the comb direction, and fur.comb_noise adds a
/// smoothly varying random tilt. If both keys are 0, the vector from the root to the tip is exactly L0 n. The
/// maps of `style` multiply L0 and fur.comb.
FaceSprings make_strands(const Skin& skin, const FurScene& fur, const WindScene& wind,
                         const Style& style = {});

/// Returns the tip of the fur at rest for each surface point. The tip is the position of the point plus a
/// weighted mean of the vectors FaceSprings::anchor of the triangles around the point.
std::vector<glm::vec3> rest_tips(const Skin& skin, const FaceSprings& strands);

/// Returns, for each surface point, the tip of its stick at rest: the position of the point plus `length`
/// times the normal at the point. In a mass-spring topology, sticks replace the strands.
std::vector<glm::vec3> rest_tips(const Skin& skin, const std::vector<glm::vec3>& normal, float length);

// The shape of the fur as a function of the position on the surface (docs/shells.md, section 8). Pictures in
// UV space, the maps, multiply the scene's values of length, curl, density and comb.

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

// Tangent vectors of the surface: the derivatives of the position with respect to UV, and the tangent frame
// of the curl.

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
