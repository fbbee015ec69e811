#include <fmt/format.h>

#include "harness/error.hpp"
#include "harness/mesh/flatten.hpp"
#include "harness/mesh/sides.hpp"
#include "harness/mesh/unfold.hpp"

namespace pelage {
namespace {

// Returns true if the triangles form a closed manifold. The function tests whether F triangles have 3F / 2
// edges, because each edge of a closed manifold belongs to two triangles.
bool is_closed(const std::vector<Surface::Triangle>& triangles) {
  const std::vector<Side> sides = sides_of(triangles);
  std::size_t edges = 0;
  for (std::size_t i = 0; i < sides.size(); ++i)
    edges += i == 0 || sides[i].low != sides[i - 1].low || sides[i].high != sides[i - 1].high;
  return 2 * edges == 3 * triangles.size();
}

}  // namespace

void need_cut(const Surface& surface, const Disk& disk, const std::string& name) {
  if (disk.point.size() == surface.point.size() && is_closed(disk.triangle))
    throw InputError(fmt::format("{}: the closed surface is not cut and cannot be flattened", name));
}

Surface with_map(const Surface& surface, const CutPlan& plan, const Disk& disk,
                 const std::vector<glm::dvec2>& uv, const std::string& method, std::size_t flipped) {
  Surface result = surface;
  result.notes.push_back(fmt::format(
      "UV map: one chart, {} vertices added at seams, {} cuts to tips of limbs, method: {}, {} faces flipped",
      disk.point.size() - surface.point.size(), plan.tips.size(), method, flipped));
  result.uv.clear();
  result.uv.reserve(disk.triangle.size());
  for (const auto& [a, b, c] : disk.triangle) result.uv.push_back({uv[a], uv[b], uv[c]});
  return result;
}

Surface unfold_large(const Surface& surface, const CutPlan& plan, const std::string& name,
                     const std::function<void(double)>& part) {
  const Disk disk = cut_open(surface, plan);
  need_cut(surface, disk, name);
  const FlatDisk flat = flatten(surface, disk, name, part);
  return with_map(surface, plan, disk, flat.uv,
                  flat.rigid ? "as rigidly as possible" : "harmonic on a circle", flat.flipped);
}

}  // namespace pelage
