// The input of a frame: all arrays from which every pipeline computes the frame. The host prepares the arrays
// once. Their values are single-precision floats, so the double-precision reference and the devices read the
// same values. docs/shells.md defines each array, and lists the papers S, W and B.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/prepare/contact.hpp"
#include "harness/scene/scene.hpp"

namespace pelage {

/// The strands of S 3.2.1. Each triangle has one strand, which is a mass on a spring. L0 is the length of the
/// fur.
struct FaceSprings {
  std::vector<glm::vec3> root;    ///< centroid of each triangle, in units of R (the mesh radius)
  std::vector<glm::vec3> normal;  ///< unit normal of each triangle
  /// Vector from each root to the strand's tip at rest. Its length is L0, or with fur.length_map the length
  /// of the strand.
  std::vector<glm::vec3> anchor;
  std::vector<glm::vec2> phase;  ///< (cos, sin) of the phase of the wind's gusts at each root
  // A sparse matrix in compressed row storage, with one row per surface point and one column per strand.
  // Vertices that differ only in their UV are one surface point. The matrix converts one value per strand to
  // one value per surface point. The value at a point is the mean over the strands of the triangles around
  // the point, weighted by the areas of these triangles.
  /// For each matrix row, the index of its first element in `face` and `weight`. The last value is the number
  /// of matrix elements, which is the size of `face` and of `weight`.
  std::vector<std::uint32_t> row;
  /// For each matrix element, its column: the index of a triangle, which is also the index of the triangle's
  /// strand.
  std::vector<std::uint32_t> face;
  std::vector<float> weight;  ///< weight of each matrix element; the sum over a row is 1
};

/// The tangent frame of the fur's curl: for each surface point, the orthonormal tangential vectors u and v of
/// S Eq. 4.
struct CurlFrame {
  std::vector<glm::vec3> u, v;  ///< one pair per surface point
  /// UV at which each surface point samples the wetness mask: the UV of the point's first vertex.
  std::vector<glm::vec2> mask_uv;
};

/// The derivatives t = dX/du and b = dX/dv of the surface position X at each vertex, in R per unit of UV. W
/// Eq. 4 uses t as the tangent and b as the bitangent.
struct SurfaceTangents {
  std::vector<glm::vec3> t, b;  ///< one pair per vertex
};

/// The maps of the fur's shape (docs/shells.md, section 8), as factors of the scene's values. An array is
/// empty if the scene has no such map. All factors are 0 to 1.
struct Style {
  /// The factor of fur.density, as a picture: height rows of width values, the top row (v = 1) first.
  struct Density {
    int width = 0, height = 0;
    std::vector<float> value;
  };
  std::vector<float> length;       ///< factor of fur.length, one per triangle, above 0
  std::vector<float> comb;         ///< factor of fur.comb, one per surface point
  std::vector<float> curl_radius;  ///< factor of curl.radius, one per surface point
  /// Factor of curl.turns, one per surface point: multiples of 1 / turn_steps.
  std::vector<float> curl_turns;
  Density density;
};

/// Returns an entry of an array of Style, or 1 if the scene has no such map.
inline float share_of(const std::vector<float>& map, std::size_t entry) {
  return map.empty() ? 1.0f : map[entry];
}

/// Number of steps of the factor of curl.turns between 0 and 1. The angles of the curls are tabulated for all
/// steps.
inline constexpr int turn_steps = 1024;

/// The fur volume texture. Mip level l has layers x side x side texels of two bytes, where side is
/// size >> l. The first byte is the coverage; 255 is opaque. The second byte is 127.5 times the shade,
/// rounded. The shade is a factor of the coat's colour. All levels have the same number of layers.
struct FurTexture {
  int size = 0;
  int layers = 0;
  std::vector<std::vector<std::array<std::uint8_t, 2>>> level;
};

/// The coat's colour: size x size texels with three bytes RGB and an unused fourth byte. The texture repeats.
struct CoatTexture {
  int size = 0;
  std::vector<std::array<std::uint8_t, 4>> texel;
};

/// A droplet of Algorithm 1 of S and W.
struct Droplet {
  glm::vec2 centre;  ///< c_drop, UV
  float radius;      ///< r_drop, UV
  float wetness;     ///< rho_drop, the wetness of the soaked droplet
  glm::vec3 point;   ///< c_mesh, the surface point at the UV c_drop, in R
  /// Maximum distance in R between `point` and the surface points of the texels that the droplet covers. This
  /// limit excludes texels of other charts, which are near in UV but far away on the surface.
  float reach;
  /// Adjacent droplets with equal numbers other than `alone` are one droplet and its repetitions across UV
  /// seams. A texel takes only the nearest of them.
  static constexpr std::uint32_t alone = 0xffffffff;
  std::uint32_t number = alone;
  float arrival = 0.0f;  ///< time at which the droplet arrives, s
};

/// The pinhole camera, docs/shells.md, section 4.
struct Camera {
  /// Rows of the projection matrix. For a point p, the dot products of row_x, row_y and row_w with (p, 1) are
  /// x * w, y * w and w. Here x and y are in pixels from the image centre, and w is the view depth in R.
  glm::vec4 row_x, row_y, row_w;
  glm::vec3 eye;  ///< R
  /// View ray through the image centre, and its changes per pixel in x and in y. The rays are not normalized.
  glm::vec3 ray, ray_dx, ray_dy;
  float pixel = 0;  ///< side length of a pixel at view depth 1, in R
  float near = 0;   ///< view depth of the near plane, in units of R (the mesh radius)
  int width = 0, height = 0;
};

struct FrameInput {
  Scene scene;
  std::shared_ptr<const Mesh> mesh;
  FaceSprings strands;
  /// For each surface point, the unit direction of its stick at rest. In a mass-spring topology, sticks
  /// replace the strands. If the scene uses no such topology, the list is empty.
  std::vector<glm::vec3> stick_normal;
  CurlFrame curl;
  Style style;
  SurfaceTangents tangents;
  FurTexture fur;
  CoatTexture coat;
  std::vector<Droplet> droplets;
  /// For each of the wetness.size^2 texels of the wetness mask, the position of the surface point whose UV is
  /// the texel's centre, in units of R (the mesh radius). A texel outside all charts has the position of the
  /// nearest texel (in UV) inside a chart.
  std::vector<glm::vec3> mask_surface;
  glm::vec2 fur_scale{1.0f};     ///< number of repeats of the fur texture per unit of u and of v
  ContactFields contact_fields;  ///< distances from the mesh contact.mesh
  Camera camera;
};

}  // namespace pelage
