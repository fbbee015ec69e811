#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <tuple>

#include "harness/error.hpp"
#include "harness/mesh/steps.hpp"

namespace pelage {
namespace {

// Returns true if the area of the map in UV space exceeds 1e-12 times the area of its bounding square. A
// smaller UV area may be rounded to 0 in single precision. Mesh::length_per_uv and the tangents would then be
// undefined.
bool has_area(const std::vector<Surface::Corners>& uv) {
  double twice = 0;
  glm::dvec2 low = uv.front()[0], high = low;
  for (const Surface::Corners& t : uv) {
    const glm::dvec2 d = t[1] - t[0], e = t[2] - t[0];
    twice += std::abs(d.x * e.y - d.y * e.x);
    for (const glm::dvec2& p : t) low = glm::min(low, p), high = glm::max(high, p);
  }
  const double side = std::max(high.x - low.x, high.y - low.y);
  return twice / 2 > 1e-12 * side * side;
}

}  // namespace

Surface weld(const Soup& soup, const std::string& name) {
  Surface surface;
  std::map<std::tuple<double, double, double>, std::uint32_t> seen;
  std::vector<std::uint32_t> number;
  for (const glm::dvec3& p : soup.point) {
    const auto [entry, fresh] = seen.try_emplace({p.x, p.y, p.z}, std::uint32_t(surface.point.size()));
    if (fresh) surface.point.push_back(p);
    number.push_back(entry->second);
  }
  std::size_t dropped = 0;
  for (std::size_t f = 0; f < soup.polygon.size(); ++f) {
    const auto& polygon = soup.polygon[f];
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      const Surface::Triangle t{number[polygon[0]], number[polygon[k]], number[polygon[k + 1]]};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
        ++dropped;
        continue;
      }
      surface.triangle.push_back(t);
      surface.uv.push_back({soup.uv[f][0], soup.uv[f][k], soup.uv[f][k + 1]});
    }
  }
  if (surface.triangle.empty()) throw InputError(fmt::format("{}: no face with an area is left", name));
  if (!has_area(surface.uv))
    throw InputError(fmt::format("{}: the file's UV map has no area; leave out --keep-uv", name));
  surface.keep_uv = true;
  surface.notes.push_back("kept the file's own UV map; nothing was repaired");
  if (surface.point.size() < soup.point.size())
    surface.notes.push_back(
        fmt::format("welded {} coincident points", soup.point.size() - surface.point.size()));
  if (dropped > 0) surface.notes.push_back(fmt::format("dropped {} degenerate faces", dropped));
  return surface;
}

}  // namespace pelage
