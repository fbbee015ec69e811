#include "harness/shells/reference/visible.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace pelage::reference {
namespace {

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
  // surface. Curls add at most the curl's radius to this distance. Strands of Silva et al. 2010 (Curling and
  // Clumping Fur) add at most L0, the fur's length. Eq. 3 of that paper keeps the control points of a
  // strand's Bezier curve within L0 of the root. The curve stays in the convex hull of its control points.
  // Sticks of a mass-spring topology add at most L0, or sqrt(2) L0 if dynamics.bend is "tangent". The factor
  // 1.01 allows for strand weights whose sum is not exactly 1.
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
