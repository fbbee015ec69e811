// The input of a frame: all arrays from which every pipeline computes the frame. The host prepares them once.
// They are floats, so the double-precision reference and the devices read the same values. docs/frame.md
// defines each array.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/scene/scene.hpp"

namespace pelage {

/// The strands: one mass on a spring per triangle (S 3.2.1). Array sizes are F, the number of triangles, and
/// W, the number of surface points.
struct StrandSet {
  std::vector<glm::vec3> root;    ///< F, centroid of the triangle, R
  std::vector<glm::vec3> normal;  ///< F, unit normal of the triangle; p0 = root + L0 normal
  std::vector<glm::vec3> anchor;  ///< F, rest tip minus root, of length L0; L0 normal unless combed
  std::vector<glm::vec2> phase;   ///< F, (cos, sin) of the gust's phase at the root
  // A sparse matrix in compressed rows. It maps strands to surface points by the area-weighted mean over the
  // triangles around the point.
  std::vector<std::uint32_t> row;   ///< W + 1 offsets into face and weight
  std::vector<std::uint32_t> face;  ///< row.back() indices of triangles
  std::vector<float> weight;        ///< row.back() weights; the sum over a row is 1
};

/// The tangent frame of the curl per surface point: the orthonormal, tangential vectors u and v of S Eq. 4.
struct CurlFrame {
  std::vector<glm::vec3> u, v;  ///< W
  /// W, the UV at which a surface point samples the wetness mask: the UV of its first vertex.
  std::vector<glm::vec2> mask_uv;
};

/// The derivatives dX/du and dX/dv per vertex, R per UV unit. They are the tangent and bitangent of W Eq. 4
/// before its change of basis.
struct SurfaceTangents {
  std::vector<glm::vec3> t, b;  ///< V
};

/// The fur volume texture. A mip level has layers x side x side texels of two bytes: coverage (255 is opaque)
/// and shade (a factor on the coat's colour, times 127.5). The side of level l is size >> l. All levels have
/// the same number of layers.
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

/// One droplet of Algorithm 1.
struct Droplet {
  glm::vec2 centre;  ///< c_drop, UV
  float radius;      ///< r_drop, UV
  float wetness;     ///< rho_drop
  glm::vec3 point;   ///< c_mesh, surface point of the centre, R
  /// The droplet covers only texels whose surface point is at most this far from `point`, R. The limit
  /// keeps the droplet off other charts that are near in UV but far away on the surface.
  float reach;
};

/// The pinhole camera, docs/frame.md, section 4.
struct Camera {
  /// Rows of the projection. Their dot products with (p, 1) are x w, y w and w: x and y in pixels from the
  /// image centre, the view depth w in R.
  glm::vec4 row_x, row_y, row_w;
  glm::vec3 eye;  ///< R
  /// View ray through the image centre and its changes per pixel in x and y; not of unit length.
  glm::vec3 ray, ray_dx, ray_dy;
  float pixel = 0;  ///< side of a pixel at view depth 1, R
  float near = 0;   ///< view depth of the near plane, R
  int width = 0, height = 0;
};

struct FrameInput {
  Scene scene;
  std::shared_ptr<const Mesh> mesh;
  StrandSet strands;
  /// W unit directions of a topology's sticks at rest; empty for Silva's strands.
  std::vector<glm::vec3> stick_normal;
  CurlFrame curl;
  SurfaceTangents tangents;
  FurTexture fur;
  CoatTexture coat;
  std::vector<Droplet> droplets;
  /// wetness.size^2 surface points, one under the centre of each texel of the mask. A texel outside all
  /// charts has the point of the nearest texel inside a chart, R.
  std::vector<glm::vec3> mask_surface;
  glm::vec2 fur_scale{1.0f};  ///< repeats of the fur texture per unit of u and of v
  Camera camera;
};

}  // namespace pelage
