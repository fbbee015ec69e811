#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include "harness/error.hpp"
#include "harness/mesh/near_points.hpp"
#include "harness/mesh/sides.hpp"
#include "harness/mesh/steps.hpp"

namespace pelage {
namespace {

// Returns true if the area of the map in UV space exceeds 1e-12 times the area of its bounding square. A
// smaller UV area may be rounded to 0 in single precision. Mesh::length_per_uv and the tangents would then be
// undefined.
bool has_area(const std::vector<Surface::Corners>& uv) {
  double twice = 0;
  glm::dvec2 low = uv.front().front(), high = low;
  for (const Surface::Corners& t : uv) {
    twice += std::abs(twice_uv_area(t));
    for (const glm::dvec2& p : t) low = glm::min(low, p), high = glm::max(high, p);
  }
  const double side = std::max(high.x - low.x, high.y - low.y);
  return twice / 2 > 1e-12 * side * side;
}

// Throws InputError if some polygons have no UV: their fur would have that of an arbitrary texel.
void need_uv(const Soup& soup, const std::string& name) {
  const auto none = [](const auto& uv) { return uv.empty(); };
  const auto count = std::ranges::count_if(soup.uv, none);
  if (count > 0)
    throw InputError(
        fmt::format("{}: {} of {} faces have no texture coordinates; give them some, or leave out --keep-uv",
                    name, count, soup.uv.size()));
}

// Returns whether most polygons have no neighbours: the components have less than four polygons on average.
bool is_in_pieces(const Soup& soup) {
  Groups groups(soup.point.size());
  std::vector<char> used(soup.point.size(), false);
  for (const auto& polygon : soup.polygon)
    for (const std::uint32_t i : polygon) groups.join(polygon.front(), i);
  for (const auto& polygon : soup.polygon)
    if (!polygon.empty()) used[groups.find(polygon.front())] = true;
  const auto pieces = std::size_t(std::ranges::count(used, true));
  return pieces > 1 && 4 * pieces > soup.polygon.size();
}

}  // namespace

std::string weld_near(Soup& soup) {
  if (!is_in_pieces(soup)) return {};
  glm::dvec3 low = soup.point.front(), high = low;
  for (const glm::dvec3& p : soup.point) low = glm::min(low, p), high = glm::max(high, p);
  const double near = 1e-6 * glm::length(high - low);
  NearPoints points(near);
  std::vector<std::uint32_t> number(soup.point.size());
  std::size_t welded = 0;
  for (std::uint32_t i = 0; i < soup.point.size(); ++i) {
    number[i] = i;
    points.around(soup.point[i], [&](std::uint32_t other) {
      if (glm::distance(soup.point[i], soup.point[other]) <= near) number[i] = std::min(number[i], other);
    });
    if (number[i] == i) points.add(soup.point[i], i);
    welded += number[i] != i && soup.point[i] != soup.point[number[i]];
  }
  for (auto& polygon : soup.polygon)
    for (std::uint32_t& i : polygon) i = number[i];
  if (welded == 0) return {};
  return fmt::format(
      "welded {} points that differ from others by less than 1e-6 of the mesh's size, because most faces had no neighbours",
      welded);
}

Surface weld(const Soup& soup, const std::string& name) {
  need_uv(soup, name);
  Surface surface;
  std::map<std::tuple<double, double, double>, std::uint32_t> seen;
  std::vector<std::optional<std::uint32_t>> number(soup.point.size());
  const auto welded = [&](std::uint32_t i) {
    const glm::dvec3& p = soup.point[i];
    if (!number[i]) number[i] = seen.try_emplace({p.x, p.y, p.z}, std::uint32_t(seen.size())).first->second;
    if (*number[i] == surface.point.size()) surface.point.push_back(p);
    return *number[i];
  };
  std::size_t dropped = 0;
  for (std::size_t f = 0; f < soup.polygon.size(); ++f) {
    const auto& polygon = soup.polygon[f];
    std::vector<glm::dvec3> corners;
    corners.reserve(polygon.size());
    for (const std::uint32_t i : polygon) corners.push_back(soup.point[i]);
    for (const auto& [a, b, c] : triangles_of(corners)) {
      if (glm::cross(corners[b] - corners[a], corners[c] - corners[a]) == glm::dvec3(0)) {
        ++dropped;
        continue;
      }
      surface.triangle.push_back({welded(polygon[a]), welded(polygon[b]), welded(polygon[c])});
      surface.uv.push_back({soup.uv[f][a], soup.uv[f][b], soup.uv[f][c]});
    }
  }
  if (surface.triangle.empty()) throw InputError(fmt::format("{}: no face with an area is left", name));
  if (!has_area(surface.uv))
    throw InputError(fmt::format("{}: the file's UV map has no area; leave out --keep-uv", name));
  surface.keep_uv = true;
  surface.notes.push_back("kept the file's own UV map; nothing was repaired");
  if (surface.point.size() < soup.point.size())
    surface.notes.push_back(
        fmt::format("coincident or unused points left out: {}", soup.point.size() - surface.point.size()));
  if (dropped > 0) surface.notes.push_back(fmt::format("dropped {} degenerate faces", dropped));
  orient(surface);
  turn_outwards(surface);
  return surface;
}

}  // namespace pelage
