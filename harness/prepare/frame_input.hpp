// Everything a frame is computed from, prepared once on the host and handed to every pipeline alike. Floats:
// a double-precision reference sees exactly what the device sees. docs/frame.md says what each entry means.
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

/// One mass on a spring per triangle (S 3.2.1); every vector is relative to the strand's root.
struct StrandSet {
  std::vector<glm::vec3> root;    ///< F, the centroid
  std::vector<glm::vec3> normal;  ///< F, unit face normal; p0 = root + L0 normal
  std::vector<glm::vec3> anchor;  ///< F, rest tip minus root, length L0; equals L0 normal unless combed
  std::vector<glm::vec2> phase;   ///< F, (cos, sin) of the gust's phase at the root
  // Strand to surface point: the area-weighted mean over the point's triangles, as compressed rows.
  std::vector<std::uint32_t> row;   ///< W + 1
  std::vector<std::uint32_t> face;  ///< row.back()
  std::vector<float> weight;        ///< row.back(), sums to 1 over a row
};

/// The curl's tangent frame per surface point: orthonormal, tangential (S Eq. 4's u and v).
struct CurlFrame {
  std::vector<glm::vec3> u, v;     ///< W
  std::vector<glm::vec2> mask_uv;  ///< W, where the point samples the wetness mask: its first copy's UV
};

/// dX/du and dX/dv per vertex copy, R per UV unit (W Eq. 4's tangent and bitangent before the base change).
struct SurfaceTangents {
  std::vector<glm::vec3> t, b;  ///< V
};

/// The fur volume: per mip level, layers x side x side texels of two bytes, coverage (255: solid) and shade
/// (factor on the coat's colour, 127.5 per 1). Level l has side size >> l; layers are never merged.
struct FurTexture {
  int size = 0;
  int layers = 0;
  std::vector<std::vector<std::array<std::uint8_t, 2>>> level;
};

/// The coat's colour, size x size texels, RGB bytes and an unused fourth; repeats.
struct CoatTexture {
  int size = 0;
  std::vector<std::array<std::uint8_t, 4>> texel;
};

/// One droplet of Algorithm 1, in the order in which it is blended.
struct Droplet {
  glm::vec2 centre;  ///< c_drop, UV
  float radius;      ///< r_drop, UV
  float wetness;     ///< rho_drop
  glm::vec3 point;   ///< c_mesh, R
  float reach;       ///< a texel whose surface point is farther than this from `point` (R) is not its
};                   ///  disc's, however near in UV: no bleeding into a foreign chart

/// The pinhole camera in the rasterizer's terms; docs/frame.md, "Camera".
struct Camera {
  glm::vec4 row_x, row_y,
      row_w;      ///< dot with (p, 1): x and y in pixels from the image centre times w; view depth w
  glm::vec3 eye;  ///< R
  glm::vec3 ray, ray_dx, ray_dy;  ///< view ray through the image centre, and its change per pixel; not unit
  float pixel = 0;                ///< R per pixel at view depth 1
  float near = 0;                 ///< R
  int width = 0, height = 0;
};

struct FrameInput {
  Scene scene;
  std::shared_ptr<const Mesh> mesh;
  StrandSet strands;
  std::vector<glm::vec3>
      stick_normal;  ///< W, unit: where a topology's sticks rest; empty for Silva's strands
  CurlFrame curl;
  SurfaceTangents tangents;
  FurTexture fur;
  CoatTexture coat;
  std::vector<Droplet> droplets;
  std::vector<glm::vec3>
      mask_surface;  ///< wetness.size^2, the surface point under each texel (gutters: the nearest chart's)
  glm::vec2 fur_scale{1.0f};  ///< fur-texture repeats per unit of u and v
  Camera camera;
};

}  // namespace pelage
