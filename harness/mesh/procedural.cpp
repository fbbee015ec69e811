#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <utility>

#include "harness/mesh/steps.hpp"

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

Surface make_torus(int around, int across, double minor_radius) {
  Surface surface;
  surface.periodic_uv = true;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / across;
      const double reach = 1 + minor_radius * std::cos(b);
      surface.point.push_back({reach * std::cos(a), minor_radius * std::sin(b), -reach * std::sin(a)});
    }
  }
  const auto point = [&](int i, int j) { return std::uint32_t((i % around) * across + j % across); };
  const auto uv = [&](int i, int j) { return glm::dvec2(double(i) / around, double(j) / across); };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      surface.triangle.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1)});
      surface.uv.push_back({uv(i, j), uv(i + 1, j), uv(i + 1, j + 1)});
      surface.triangle.push_back({point(i, j), point(i + 1, j + 1), point(i, j + 1)});
      surface.uv.push_back({uv(i, j), uv(i + 1, j + 1), uv(i, j + 1)});
    }
  }
  return surface;
}

Surface make_square(int quads) {
  Surface surface;
  const auto add = [&](double u, double v) { surface.point.push_back({u, 0, -v}); };
  for (int j = 0; j <= quads; ++j)
    for (int i = 0; i <= quads; ++i) add(double(i) / quads, double(j) / quads);
  for (int j = 0; j < quads; ++j)
    for (int i = 0; i < quads; ++i) add((i + 0.5) / quads, (j + 0.5) / quads);
  const auto uv = [&](std::uint32_t p) { return glm::dvec2(surface.point[p].x, -surface.point[p].z); };
  for (int j = 0; j < quads; ++j) {
    for (int i = 0; i < quads; ++i) {
      const auto corner = [&](int x, int y) { return std::uint32_t(y * (quads + 1) + x); };
      const std::uint32_t ring[] = {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
      const auto centre = std::uint32_t((quads + 1) * (quads + 1) + j * quads + i);
      for (int k = 0; k < 4; ++k) {
        const std::uint32_t a = ring[k], b = ring[(k + 1) % 4];
        surface.triangle.push_back({a, b, centre});
        surface.uv.push_back({uv(a), uv(b), uv(centre)});
      }
    }
  }
  return surface;
}

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
