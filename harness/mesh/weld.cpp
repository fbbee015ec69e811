#include <fmt/format.h>

#include <map>
#include <tuple>

#include "harness/error.hpp"
#include "harness/mesh/steps.hpp"

namespace pelage {

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
  surface.keep_uv = true;
  surface.notes.push_back("kept the file's own UV map; nothing was repaired");
  if (surface.point.size() < soup.point.size())
    surface.notes.push_back(
        fmt::format("welded {} coincident points", soup.point.size() - surface.point.size()));
  if (dropped > 0) surface.notes.push_back(fmt::format("dropped {} degenerate faces", dropped));
  return surface;
}

}  // namespace pelage
