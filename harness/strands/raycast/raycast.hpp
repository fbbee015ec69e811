// Ray-casts strands as cones. The picture is what pictures of strands and of shells approximate, so
// experiments compare both with it. The rays are cast by Embree.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/picture/picture.hpp"
#include "harness/strands/drawing/drawing.hpp"

namespace pelage::strands {

/// Colour and alpha of a strand or of the skin at one place.
struct Paint {
  glm::vec3 colour{0};
  float alpha = 1;
};

struct RaycastScene {
  Camera camera;
  glm::vec3 background{0};
  /// Returns half of the width of a strand at the parameter t of its curve, R; empty: half of
  /// DrawnStrand::width everywhere.
  std::function<float(std::uint32_t strand, float t)> radius;
  /// Returns the paint of the strand with the index `strand` at the parameter t of its curve, 0 at the root
  /// and 1 at the tip.
  std::function<Paint(std::uint32_t strand, float t)> strand_paint;
  /// The skin, which hides what is behind it; null: no skin.
  std::shared_ptr<const Mesh> skin;
  /// Returns the paint of the skin in a triangle of the mesh. `weight` has the barycentric weights of the
  /// second and the third corner. The alpha counts as 1.
  std::function<Paint(std::uint32_t triangle, glm::vec2 weight)> skin_paint;
};

struct RaycastOptions {
  int cones = 16;   ///< number of cones per strand, at least 1
  int samples = 4;  ///< rays per pixel in x and in y, on a regular grid
};

struct RaycastResult {
  Picture picture;         ///< alpha is the mean over a pixel's rays of 1 minus the transmittance
  std::uint64_t hits = 0;  ///< number of strands that the rays entered, up to the skin
};

/// Casts the rays of all pixels. Each strand is a chain of `cones` truncated cones along its Bezier curve.
/// Where a ray enters a strand, it is blended with the strand's paint. Uses all cores.
RaycastResult raycast(const RaycastScene& scene, const std::vector<DrawnStrand>& strands,
                      const RaycastOptions& options = {});

}  // namespace pelage::strands
