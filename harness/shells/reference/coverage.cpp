#include "harness/shells/reference/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace pelage::reference {
namespace {

double row(const glm::vec4& r, const glm::dvec3& p) {
  return double(r.x) * p.x + double(r.y) * p.y + double(r.z) * p.z + double(r.w);
}

/// Returns the point where the segment from `in` (distance >= 0) to `out` (distance < 0) meets the clip plane
/// (distance = 0). The first argument is always the end with distance >= 0, so that two triangles with a
/// common edge compute the same rounded point on this edge.
ClippedVertex crossing(const ClippedVertex& in, double d_in, const ClippedVertex& out, double d_out) {
  const double t = d_in / (d_in - d_out);
  const auto mix = [t](double a, double b) { return a + t * (b - a); };
  return {{mix(in.point.x, out.point.x), mix(in.point.y, out.point.y), mix(in.point.w, out.point.w)},
          in.corners + t * (out.corners - in.corners)};
}

/// Returns the part of a convex polygon where distance(point) >= 0. This is one step of Sutherland and
/// Hodgman's clipping.
template <class Distance>
std::vector<ClippedVertex> cut(const std::vector<ClippedVertex>& polygon, const Distance& distance) {
  std::vector<ClippedVertex> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ClippedVertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = distance(a.point), db = distance(b.point);
    if (da >= 0.0) kept.push_back(a);
    if (da >= 0.0 && db < 0.0) kept.push_back(crossing(a, da, b, db));
    if (da < 0.0 && db >= 0.0) kept.push_back(crossing(b, db, a, da));
  }
  return kept;
}

/// Returns (b - a) x (p - a). It is positive if a, b and p are in clockwise order in the picture (y down).
std::int64_t turn(const Snapped& a, const Snapped& b, const Snapped& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Returns whether a -> b is a top edge or a left edge of a triangle with clockwise corners (y down). A top
/// edge points to the right. A left edge points upwards.
bool top_or_left(const Snapped& a, const Snapped& b) {
  return b.y < a.y || (b.y == a.y && b.x > a.x);
}

int floor_div(std::int64_t a, std::int64_t b) {
  return int(a >= 0 ? a / b : -((-a + b - 1) / b));
}

}  // namespace

ClipPoint project(const Camera& camera, const glm::dvec3& point) {
  return {row(camera.row_x, point), row(camera.row_y, point), row(camera.row_w, point)};
}

std::vector<ClippedVertex> clip(const std::array<ClipPoint, 3>& triangle, double near) {
  std::vector<ClippedVertex> polygon{
      {triangle[0], {1, 0, 0}}, {triangle[1], {0, 1, 0}}, {triangle[2], {0, 0, 1}}};
  polygon = cut(polygon, [near](const ClipPoint& p) { return p.w - near; });
  polygon = cut(polygon, [](const ClipPoint& p) { return guard * p.w - p.x; });
  polygon = cut(polygon, [](const ClipPoint& p) { return guard * p.w + p.x; });
  polygon = cut(polygon, [](const ClipPoint& p) { return guard * p.w - p.y; });
  return cut(polygon, [](const ClipPoint& p) { return guard * p.w + p.y; });
}

Snapped snap(const ClipPoint& point) {
  // In the default rounding mode, llrint rounds to nearest, ties to even.
  return {std::llrint(point.x / point.w * 256.0), std::llrint(point.y / point.w * 256.0)};
}

Raster::Raster(const std::array<Snapped, 3>& corners, int width, int height)
    : corner_(corners), width_(width), height_(height), area_(turn(corners[0], corners[1], corners[2])) {}

Edges Raster::edges(int i, int j) const {
  // The centre of pixel i is at i + .5 - width / 2 pixels, which is 256 * i + 128 - 128 * width in units of
  // 1/256 pixel.
  const Snapped p{256 * std::int64_t(i) + 128 - 128 * std::int64_t(width_),
                  256 * std::int64_t(j) + 128 - 128 * std::int64_t(height_)};
  Edges result{{0, 0, 0}, area_ != 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const Snapped *a = &corner_[(k + 1) % 3], *b = &corner_[(k + 2) % 3];
    if (area_ < 0) std::swap(a, b);
    result.value[k] = turn(*a, *b, p);
    if (result.value[k] < 0 || (result.value[k] == 0 && !top_or_left(*a, *b))) result.covered = false;
  }
  return result;
}

Window Raster::box(const Window& window) const {
  const auto [x0, x1] = std::minmax({corner_[0].x, corner_[1].x, corner_[2].x});
  const auto [y0, y1] = std::minmax({corner_[0].y, corner_[1].y, corner_[2].y});
  const auto pixel = [](std::int64_t s, int size) { return floor_div(s + 128 * std::int64_t(size), 256); };
  const int left = std::max(window.x, pixel(x0, width_)), top = std::max(window.y, pixel(y0, height_));
  const int right = std::min(window.x + window.width, pixel(x1, width_) + 1);
  const int bottom = std::min(window.y + window.height, pixel(y1, height_) + 1);
  return {left, top, std::max(0, right - left), std::max(0, bottom - top)};
}

}  // namespace pelage::reference
