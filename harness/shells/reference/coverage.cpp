#include "harness/shells/reference/coverage.hpp"

#include <algorithm>
#include <array>
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

/// The half space n.p + d >= 0. n need not be a unit vector.
struct Plane {
  glm::dvec3 n;
  double d;
  bool misses(const glm::dvec3& centre, double radius) const {
    return glm::dot(n, centre) + d + glm::length(n) * radius < 0.0;
  }
};

/// Returns the half space of the points p with sign * (dot(row, (p, 1)) - bound * w) >= 0. Here w is
/// dot(row_w, (p, 1)), and `sign` is 1 or -1. In front of the eye, the half space contains the points whose
/// screen coordinate in pixels is at least `bound` (if sign is 1) or at most `bound` (if sign is -1). The
/// screen coordinate is x / w if `row` is row_x of the camera, and y / w if it is row_y.
Plane side(const glm::vec4& row, const glm::vec4& row_w, double bound, double sign) {
  const glm::dvec4 r = sign * (glm::dvec4(row) - bound * glm::dvec4(row_w));
  return {glm::dvec3(r), r.w};
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

std::vector<Window> split(const std::vector<Window>& windows, const Camera& camera) {
  constexpr int side = 64;
  const std::vector<Window> all{{0, 0, camera.width, camera.height}};
  std::vector<Window> pieces;
  for (const Window& w : windows.empty() ? all : windows) {
    const int left = std::max(0, w.x), right = std::min(camera.width, w.x + w.width);
    const int top = std::max(0, w.y), bottom = std::min(camera.height, w.y + w.height);
    for (int y = top; y < bottom; y += side)
      for (int x = left; x < right; x += side)
        pieces.push_back({x, y, std::min(side, right - x), std::min(side, bottom - y)});
  }
  return pieces;
}

std::vector<std::uint32_t> visible_faces(const FrameInput& input, const Window& window) {
  const Camera& camera = input.camera;
  const Mesh& mesh = *input.mesh;
  // The window is enlarged by one pixel on every side, because snapping moves the corners of triangles.
  const double left = double(window.x) - 1.0 - 0.5 * double(camera.width);
  const double top = double(window.y) - 1.0 - 0.5 * double(camera.height);
  const std::array<Plane, 5> planes{
      side(camera.row_x, camera.row_w, left, 1.0),
      side(camera.row_x, camera.row_w, left + window.width + 2.0, -1.0),
      side(camera.row_y, camera.row_w, top, 1.0),
      side(camera.row_y, camera.row_w, top + window.height + 2.0, -1.0),
      Plane{glm::dvec3(camera.row_w), double(camera.row_w.w) - double(camera.near)}};
  // `reach` is an upper bound of the distance between a vertex on a layer and the same vertex on the base
  // surface. Curls add at most the curl's radius to this distance. Strands of S add at most L0, the fur's
  // length. Eq. 3 of that paper keeps the control points of a strand's Bezier curve within L0 of the root.
  // The curve stays in the convex hull of its control points. Sticks of a mass-spring topology add at most
  // L0, or sqrt(2) L0 if dynamics.bend is "tangent". The factor 1.01 allows for strand weights whose sum is
  // not exactly 1.
  const double lean = input.scene.dynamics.bend == "tangent" ? std::sqrt(2.0) : 1.0;
  const double reach =
      1.01 * (lean * double(input.scene.fur.length) + std::abs(double(input.scene.curl.radius))) + 1e-6;

  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < mesh.triangle.size(); ++f) {
    const glm::dvec3 a(mesh.position[mesh.triangle[f].x]), b(mesh.position[mesh.triangle[f].y]),
        c(mesh.position[mesh.triangle[f].z]), centre = (a + b + c) / 3.0;
    const double radius =
        std::sqrt(std::max({glm::dot(a - centre, a - centre), glm::dot(b - centre, b - centre),
                            glm::dot(c - centre, c - centre)})) +
        reach;
    if (std::none_of(planes.begin(), planes.end(), [&](const Plane& p) { return p.misses(centre, radius); }))
      faces.push_back(f);
  }
  return faces;
}

}  // namespace pelage::reference
