#include <algorithm>
#include <compare>
#include <numeric>
#include <tuple>

#include "harness/mesh/read/soup.hpp"

namespace pelage {
namespace {

using Indices = std::vector<std::uint32_t>;
using Corners = std::vector<glm::dvec2>;  // UV of the corners of a face, or empty

std::tuple<double, double, double> key(const glm::dvec3& p) {
  return {p.x, p.y, p.z};
}

/// Compares the corner lists of two faces, read from the corners `a` and `b` on. The points decide; if all of
/// them are equal, their UV decide.
std::partial_ordering compare(const Indices& face, const Corners& uv, std::size_t a, const Indices& other,
                              const Corners& other_uv, std::size_t b) {
  const std::size_t n = face.size();
  if (const auto order = n <=> other.size(); std::is_neq(order)) return order;
  if (const auto order = uv.size() <=> other_uv.size(); std::is_neq(order)) return order;
  for (std::size_t k = 0; k < n; ++k)
    if (const auto order = face[(a + k) % n] <=> other[(b + k) % n]; std::is_neq(order)) return order;
  for (std::size_t k = 0; k < n && !uv.empty(); ++k) {
    const glm::dvec2 p = uv[(a + k) % n], q = other_uv[(b + k) % n];
    if (const auto order = std::tie(p.x, p.y) <=> std::tie(q.x, q.y); std::is_neq(order)) return order;
  }
  return std::partial_ordering::equivalent;
}

Indices order_of(std::size_t count) {
  Indices order(count);
  std::iota(order.begin(), order.end(), 0u);
  return order;
}

/// Sorts the points, and returns the new number of each old point.
Indices sort_points(std::vector<glm::dvec3>& point) {
  Indices order = order_of(point.size()), number(point.size());
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return key(point[i]); });
  std::vector<glm::dvec3> sorted;
  sorted.reserve(point.size());
  std::uint32_t first = 0;  // of the coincident points
  for (const std::uint32_t i : order) {
    if (sorted.empty() || sorted[first] != point[i]) first = std::uint32_t(sorted.size());
    sorted.push_back(point[i] + 0.0);
    number[i] = first;
  }
  point = std::move(sorted);
  return number;
}

}  // namespace

void sort_soup(Soup& soup) {
  const Indices number = sort_points(soup.point);
  const Corners none;
  const auto uv_of = [&](std::size_t f) -> const Corners& { return soup.uv.empty() ? none : soup.uv[f]; };
  for (std::size_t f = 0; f < soup.polygon.size(); ++f) {
    Indices& face = soup.polygon[f];
    for (std::uint32_t& i : face) i = number[i];
    std::size_t start = 0;
    for (std::size_t k = 1; k < face.size(); ++k)
      if (std::is_lt(compare(face, uv_of(f), k, face, uv_of(f), start))) start = k;
    std::rotate(face.begin(), face.begin() + std::ptrdiff_t(start), face.end());
    if (!uv_of(f).empty())
      std::rotate(soup.uv[f].begin(), soup.uv[f].begin() + std::ptrdiff_t(start), soup.uv[f].end());
  }
  Indices order = order_of(soup.polygon.size());
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::is_lt(compare(soup.polygon[a], uv_of(a), 0, soup.polygon[b], uv_of(b), 0));
  });
  Soup sorted;
  for (const std::uint32_t f : order) {
    sorted.polygon.push_back(std::move(soup.polygon[f]));
    if (!soup.uv.empty()) sorted.uv.push_back(std::move(soup.uv[f]));
  }
  soup.polygon = std::move(sorted.polygon);
  soup.uv = std::move(sorted.uv);
}

}  // namespace pelage
