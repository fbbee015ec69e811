#include <fmt/format.h>

#include <algorithm>

#include "harness/error.hpp"
#include "harness/mesh/flatten.hpp"
#include "harness/mesh/unfold.hpp"

namespace pelage {
namespace {

// Returns true if the triangles form a closed manifold. The function tests whether F triangles have 3F / 2
// edges, because each edge of a closed manifold belongs to two triangles.
bool is_closed(const std::vector<Surface::Triangle>& triangles) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;
  sides.reserve(triangles.size() * 3);
  for (const auto& [a, b, c] : triangles)
    for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      sides.emplace_back(std::min(p, q), std::max(p, q));
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  return 2 * sides.size() == 3 * triangles.size();
}

}  // namespace

void need_cut(const Surface& surface, const Disk& disk, const std::string& name) {
  if (disk.point.size() == surface.point.size() && is_closed(disk.triangle))
    throw InputError(fmt::format("{}: the closed surface is not cut and cannot be flattened", name));
}

Surface unfold_large(const Surface& surface, const CutPlan& plan, const std::string& name,
                     const std::function<void(double)>& part) {
  const Disk disk = cut_open(surface, plan);
  need_cut(surface, disk, name);
  const FlatDisk flat = flatten(surface, disk, name, part);
  Surface result = surface;
  result.notes.push_back(fmt::format(
      "UV map: one chart, {} vertices added at seams, {} cuts to tips of limbs, method: {}, {} faces flipped",
      disk.point.size() - surface.point.size(), plan.tips.size(),
      flat.rigid ? "as rigidly as possible" : "harmonic on a circle", flat.flipped));
  result.uv.clear();
  result.uv.reserve(disk.triangle.size());
  for (const auto& [a, b, c] : disk.triangle) result.uv.push_back({flat.uv[a], flat.uv[b], flat.uv[c]});
  return result;
}

}  // namespace pelage
