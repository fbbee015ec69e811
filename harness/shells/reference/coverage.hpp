// From a triangle in space to the pixels it covers (docs/frame.md, 4): clipping, snapping, exact edges.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::reference {

/// A point as the camera sees it: x and y in pixels from the image centre times w, and w, the view depth in
/// R.
struct ClipPoint {
  double x, y, w;
};
ClipPoint project(const Camera& camera, const glm::dvec3& point);

/// A vertex of a clipped triangle: the point, and how it mixes the triangle's three corners.
struct ClippedVertex {
  ClipPoint point;
  glm::dvec3 corners;
};

/// Screen coordinates beyond +-guard pixels are clipped away.
constexpr double guard = 16384.0;

/// The part of the triangle with w >= near and |x|, |y| <= guard pixels: a convex polygon of 0 or 3 to 8
/// vertices.
std::vector<ClippedVertex> clip(const std::array<ClipPoint, 3>& triangle, double near);

/// A screen position relative to the image centre in 1/256 pixel.
struct Snapped {
  std::int64_t x, y;
  bool operator==(const Snapped&) const = default;
};
Snapped snap(const ClipPoint& point);

/// The edge functions of a triangle at a pixel's centre, as integers: each belongs to the corner opposite to
/// its edge. They sum to the (doubled) area, which is positive whatever the winding.
struct Edges {
  std::array<std::int64_t, 3> value;
  bool covered;  ///< inside, or on a top or left edge
};

/// A triangle of snapped corners over an image of width x height pixels.
class Raster {
 public:
  Raster(const std::array<Snapped, 3>& corners, int width, int height);
  bool empty() const { return area_ == 0; }
  bool faces_away() const { return area_ < 0; }  ///< clockwise in the picture's y-up sense
  Edges edges(int i, int j) const;               ///< at the centre of pixel (i, j)
  /// The pixels of `window` that can be covered (the triangle's box); width or height may be 0.
  Window box(const Window& window) const;

 private:
  std::array<Snapped, 3> corner_;
  int width_, height_;
  std::int64_t area_;  ///< signed, doubled
};

}  // namespace pelage::reference
