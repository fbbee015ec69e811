#include "harness/mesh/uv_overlap.hpp"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace pelage {
namespace {

constexpr double least_depth = 1e-9;

/// Returns true if a line along an edge of `a` separates the triangles, except for a depth below least_depth.
bool edge_separates(const Surface::Corners& a, const Surface::Corners& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 along = a[(k + 1) % 3] - a[k];
    const double length = glm::length(along);
    if (!(length > 0)) return true;
    const glm::dvec2 across = glm::dvec2(-along.y, along.x) / length;
    const auto height = [&](const glm::dvec2& p) { return glm::dot(across, p - a[k]); };
    const double own = height(a[(k + 2) % 3]);
    const auto [low, high] = std::minmax({height(b[0]), height(b[1]), height(b[2])});
    if (std::min(high, std::max(own, 0.0)) - std::max(low, std::min(own, 0.0)) < least_depth) return true;
  }
  return false;
}

}  // namespace

double twice_uv_area(const Surface::Corners& uv) {
  const glm::dvec2 d = uv[1] - uv[0], e = uv[2] - uv[0];
  return d.x * e.y - d.y * e.x;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> uv_overlaps(const std::vector<Surface::Corners>& uv) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, std::uint32_t>;
  std::vector<Box> boxes;
  boxes.reserve(uv.size());
  for (std::uint32_t f = 0; f < uv.size(); ++f) {
    const auto [left, right] = std::minmax({uv[f][0].x, uv[f][1].x, uv[f][2].x});
    const auto [low, high] = std::minmax({uv[f][0].y, uv[f][1].y, uv[f][2].y});
    double from[] = {left, low}, to[] = {right, high};
    boxes.emplace_back(from, to, f);
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& x, const Box& y) {
    const std::uint32_t a = std::min(x.info(), y.info()), b = std::max(x.info(), y.info());
    if (!edge_separates(uv[a], uv[b]) && !edge_separates(uv[b], uv[a])) pairs.emplace_back(a, b);
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace pelage
