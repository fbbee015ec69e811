// Computes the pixels that a triangle covers: clipping, snapping to 1/256 pixel, exact edge functions
// (docs/shells.md, section 4); and the triangles that can be visible in a part of the picture.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::reference {

/// A point in homogeneous screen coordinates. (x / w, y / w) is the position relative to the image centre, in
/// pixels, with y pointing down. w is the view depth. Its unit is the radius of the mesh's bounding sphere.
struct ClipPoint {
  double x, y, w;
};
ClipPoint project(const Camera& camera, const glm::dvec3& point);

/// A vertex of a clipped triangle: its position, and its barycentric weights in the unclipped triangle.
struct ClippedVertex {
  ClipPoint point;
  glm::dvec3 corners;
};

/// Triangles are clipped at this distance from the image centre in x and y, in pixels.
constexpr double guard = 16384.0;

/// Returns the part of the triangle with w >= near, |x / w| <= guard and |y / w| <= guard. The result is a
/// convex polygon of 3 to 8 vertices, or has no vertices if nothing is left.
std::vector<ClippedVertex> clip(const std::array<ClipPoint, 3>& triangle, double near);

/// A screen position relative to the image centre, in units of 1/256 pixel.
struct Snapped {
  std::int64_t x, y;
  bool operator==(const Snapped&) const = default;
};
Snapped snap(const ClipPoint& point);

/// The integer edge functions of a triangle at the centre of a pixel. value[k] belongs to the edge opposite
/// to corner k. The sum of the values is twice the triangle's area, and positive for both windings.
struct Edges {
  std::array<std::int64_t, 3> value;
  bool covered;  ///< true if the centre is inside, or on a top or left edge
};

/// A triangle with snapped corners in an image of width x height pixels.
class Raster {
 public:
  Raster(const std::array<Snapped, 3>& corners, int width, int height);
  bool empty() const { return area_ == 0; }
  bool faces_eye() const { return area_ < 0; }  ///< true if the corners are counter-clockwise in the picture
  Edges edges(int i, int j) const;              ///< edge functions at the centre of pixel (i, j)
  /// Returns the intersection of `window` and the triangle's bounding box, in pixels. Its width or height may
  /// be 0.
  Window box(const Window& window) const;

 private:
  std::array<Snapped, 3> corner_;
  int width_, height_;
  std::int64_t area_;  ///< twice the signed area
};

/// Clips the windows to the picture and splits them into windows of at most 64 x 64 pixels. Without windows,
/// splits the whole picture.
std::vector<Window> split(const std::vector<Window>& windows, const Camera& camera);

/// Returns the faces that may cover a pixel of the window on some layer, in the mesh's order. For each face,
/// the function tests a ball that contains the face on all layers, no matter how the strands move. The result
/// can therefore contain faces that cover no pixel of the window.
std::vector<std::uint32_t> visible_faces(const FrameInput& input, const Window& window);

}  // namespace pelage::reference
