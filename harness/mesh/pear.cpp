#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "harness/mesh/procedural.hpp"

namespace pelage {
namespace {

// Implicit function of the pear: negative inside the pear, zero on its surface. The pear is the smooth union
// of a wide sphere below and a narrow sphere above. The smooth minimum has the blend width 0.6. The top has a
// shallow dimple, where the stem of a pear would be. The pear extends from y = -0.98 to about 0.9.
double pear(glm::dvec3 p) {
  const double across = p.x * p.x + p.z * p.z, y = p.y;
  const double low = std::sqrt(across + (y + 0.3) * (y + 0.3)) - 0.68;
  const double high = std::sqrt(across + (y - 0.62) * (y - 0.62)) - 0.27;
  const double blend = 0.6, h = std::max(blend - std::abs(low - high), 0.0) / blend;
  const double body = std::min(low, high) - h * h * blend / 4;
  const double dimple = 0.09 * std::exp(-(across + (y - 0.92) * (y - 0.92)) / 0.02);
  return body + dimple;
}

// Returns the point where the ray from (0, 0.1, 0) along `direction` intersects the pear's surface. There is
// exactly one such point.
glm::dvec3 on_the_pear(glm::dvec3 direction) {
  const glm::dvec3 middle(0, 0.1, 0), along = glm::normalize(direction);
  double inside = 0, outside = 2;
  for (int i = 0; i < 50; ++i) {
    const double half = 0.5 * (inside + outside);
    (pear(middle + half * along) < 0 ? inside : outside) = half;
  }
  return middle + inside * along;
}

Surface icosahedron() {
  const double g = 0.5 * (1 + std::sqrt(5.0));
  Surface s;
  s.point = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
             {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  s.triangle = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return s;
}

// Splits each triangle into four at the midpoints of its edges.
Surface halved(const Surface& s) {
  Surface fine;
  fine.point = s.point;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [found, added] = middles.try_emplace(std::minmax(a, b), std::uint32_t(fine.point.size()));
    if (added) fine.point.push_back(0.5 * (s.point[a] + s.point[b]));
    return found->second;
  };
  for (const auto& [a, b, c] : s.triangle) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.triangle.insert(fine.triangle.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return fine;
}

}  // namespace

Surface make_pear(int halvings) {
  Surface s = icosahedron();
  for (glm::dvec3& p : s.point) p = on_the_pear(p);
  for (int i = 0; i < halvings; ++i) {
    s = halved(s);
    for (glm::dvec3& p : s.point) p = on_the_pear(p - glm::dvec3(0, 0.1, 0));
  }
  return s;
}

}  // namespace pelage
