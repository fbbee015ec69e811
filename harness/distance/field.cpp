#include "harness/distance/field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <utility>

#include "harness/error.hpp"
#include "harness/hash.hpp"
#include "harness/mesh/disk_cache.hpp"

namespace pelage {
namespace {

constexpr int margin = 2;  // cells beyond the bounding box

using Corners = std::array<glm::dvec3, 3>;

glm::dvec2 seen_along_x(glm::dvec3 v) {
  return {v.y, v.z};
}

bool before(glm::dvec2 a, glm::dvec2 b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

/// Returns whether p is to the left of the directed edge from a to b. A point on the line counts as moved by
/// (-e^2, e) with an infinitely small e. All edges move it in the same way, and an edge gives opposite
/// answers for its two directions. A ray therefore never passes between two adjacent triangles.
bool left_of(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
  if (before(b, a)) return !left_of(b, a, p);
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) >= 0;
}

/// Returns triangles that close the small holes of the mesh, or nothing if it has a larger hole.
std::optional<std::vector<Corners>> fillings(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;  // forwards minus backwards
  std::vector<glm::dvec3> position(mesh.welded);
  for (std::size_t v = 0; v < mesh.position.size(); ++v) position[mesh.weld[v]] = mesh.position[v];
  for (const glm::uvec3& t : mesh.triangle)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.weld[t[k]], b = mesh.weld[t[(k + 1) % 3]];
      if (a != b) uses[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  std::erase_if(uses, [](const auto& edge) { return edge.second == 0; });
  if (uses.size() * 16 > mesh.triangle.size()) return {};  // a patch is not a body with a hole
  // Connected edges belong to one hole. `hole` maps a point to another point of its hole, or to itself.
  std::map<std::uint32_t, std::uint32_t> hole;
  const auto name_of = [&](std::uint32_t point) {
    hole.emplace(point, point);
    while (hole[point] != point) point = hole[point];
    return point;
  };
  for (const auto& [edge, count] : uses) hole[name_of(edge.first)] = name_of(edge.second);
  std::map<std::uint32_t, std::pair<glm::dvec3, std::size_t>> sums;
  for (const auto& [edge, count] : uses) {
    auto& [sum, edges] = sums[name_of(edge.first)];
    sum += position[edge.first] + position[edge.second];
    if (++edges > small_hole) return {};
  }
  std::vector<Corners> found;
  for (const auto& [edge, count] : uses) {
    const auto& [sum, edges] = sums[name_of(edge.first)];
    const glm::dvec3 centre = sum / (2.0 * double(edges)), a = position[edge.first],
                     b = position[edge.second];
    for (int i = 0; i < std::abs(count); ++i)
      found.push_back(count > 0 ? Corners{b, a, centre} : Corners{a, b, centre});
  }
  return found;
}

std::shared_ptr<const Mesh> closed(std::shared_ptr<const Mesh> mesh) {
  if (!is_closed(*mesh))
    throw InputError(
        "mesh '" + mesh->name +
        "': it is not closed, so it has no inside; strands on it collide with the plane of their own skin only");
  return mesh;
}

}  // namespace

DistanceField grid_of(const Mesh& mesh, int cells) {
  if (cells < 4 || cells > 256)
    throw InputError(fmt::format("cells of the body's distance field: {}; it must be from 4 to 256", cells));
  glm::vec3 least(mesh.position.front()), most = least;
  const auto add = [&](const std::vector<glm::vec3>& points) {
    for (const glm::vec3& p : points) least = glm::min(least, p), most = glm::max(most, p);
  };
  add(mesh.position);
  for (const std::vector<glm::vec3>& frame : mesh.frames) add(frame);
  const glm::vec3 size = most - least;
  DistanceField f;
  f.mesh = mesh.hash;
  f.cell = std::max({size.x, size.y, size.z, 1e-6f}) / float(cells);
  f.nodes = glm::ivec3(glm::ceil(size / f.cell)) + 1 + 2 * margin;
  f.origin = (least + most) / 2.0f - 0.5f * f.cell * glm::vec3(f.nodes - 1);
  return f;
}

namespace {

/// Sets the distances of the grid `f` from a mesh.
DistanceField filled(DistanceField f, const std::shared_ptr<const Mesh>& mesh) {
  const ClosedSurface surface(mesh);
  f.distance.reserve(std::size_t(f.nodes.x) * std::size_t(f.nodes.y) * std::size_t(f.nodes.z));
  for (int z = 0; z < f.nodes.z; ++z)
    for (int y = 0; y < f.nodes.y; ++y)
      for (int x = 0; x < f.nodes.x; ++x)
        f.distance.push_back(float(surface.distance(f.origin + f.cell * glm::vec3(x, y, z))));
  return f;
}

/// Returns a field from the cache, or computes it by `compute` and writes it to the cache.
template <class Compute>
std::shared_ptr<const DistanceField> kept(const std::string& hash, const Compute& compute) {
  const auto parts = [](const auto& store, auto& f) {
    return store(f.mesh) && store(f.nodes) && store(f.origin) && store(f.cell) && store(f.distance);
  };
  return std::make_shared<const DistanceField>(
      cached<DistanceField>(cache_folder() / "fields" / ("field-" + hash), "pelage field 1\n",
                            std::uintmax_t(64) << 20, parts, compute));
}

}  // namespace

DistanceField distance_field(const std::shared_ptr<const Mesh>& mesh, int cells) {
  return filled(grid_of(*mesh, cells), mesh);
}

std::shared_ptr<const DistanceField> kept_distance_field(const std::shared_ptr<const Mesh>& mesh, int cells) {
  if (mesh->hash.empty()) return std::make_shared<const DistanceField>(distance_field(mesh, cells));
  return kept(Hash().text(mesh->hash).number(std::uint64_t(cells)).hex(),
              [&] { return distance_field(mesh, cells); });
}

std::vector<std::shared_ptr<const DistanceField>> kept_distance_fields(
    const std::shared_ptr<const Mesh>& mesh, int cells) {
  const DistanceField grid = grid_of(*mesh, cells);
  std::vector<std::shared_ptr<const DistanceField>> fields(mesh->frames.size());
  for (std::size_t i = 0; i < fields.size(); ++i)
    fields[i] =
        kept(Hash().text(mesh->hash).number(std::uint64_t(cells)).number(std::uint64_t(i)).hex(), [&] {
          auto frame = std::make_shared<Mesh>(*mesh);
          frame->frames.clear();
          for (std::size_t v = 0; v < frame->position.size(); ++v)
            frame->position[v] = mesh->frames[i][mesh->weld[v]];
          return filled(grid, frame);
        });
  return fields;
}

double value_at(const DistanceField& field, glm::dvec3 point) {
  const glm::dvec3 at = glm::clamp((point - glm::dvec3(field.origin)) / double(field.cell), glm::dvec3(0),
                                   glm::dvec3(field.nodes - 1));
  const glm::ivec3 low = glm::min(glm::ivec3(at), field.nodes - 2);
  const glm::dvec3 t = at - glm::dvec3(low);
  const auto node = [&](int x, int y, int z) {
    const glm::ivec3 at_node = low + glm::ivec3(x, y, z);
    const auto across = std::size_t(field.nodes.x), down = std::size_t(field.nodes.y);
    return double(field.distance[std::size_t(at_node.x) +
                                 across * (std::size_t(at_node.y) + down * std::size_t(at_node.z))]);
  };
  const auto row = [&](int y, int z) { return glm::mix(node(0, y, z), node(1, y, z), t.x); };
  return glm::mix(glm::mix(row(0, 0), row(1, 0), t.y), glm::mix(row(0, 1), row(1, 1), t.y), t.z);
}

bool is_closed(const Mesh& mesh) {
  return !mesh.triangle.empty() && fillings(mesh).has_value();
}

ClosedSurface::ClosedSurface(const std::shared_ptr<const Mesh>& mesh)
    : triangles_(*fillings(*closed(mesh))), search_(mesh) {
  glm::dvec2 most(-1e300);
  least_ = glm::dvec2(1e300);
  for (const glm::uvec3& t : mesh->triangle) {
    triangles_.push_back(
        {glm::dvec3(mesh->position[t.x]), glm::dvec3(mesh->position[t.y]), glm::dvec3(mesh->position[t.z])});
    for (const glm::dvec3& corner : triangles_.back()) {
      least_ = glm::min(least_, seen_along_x(corner));
      most = glm::max(most, seen_along_x(corner));
    }
  }
  side_ = std::clamp(int(std::sqrt(double(triangles_.size())) / 2), 1, 512);
  per_bin_ = double(side_) / glm::max(most - least_, glm::dvec2(1e-9));
  // The first pass counts the triangles of each bin, and the second pass writes their numbers.
  row_.assign(std::size_t(side_) * std::size_t(side_) + 2, 0);
  for (const bool writing : {false, true}) {
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const auto& [a, b, c] = triangles_[i];
      const glm::dvec2 low = seen_along_x(glm::min(a, glm::min(b, c))),
                       high = seen_along_x(glm::max(a, glm::max(b, c)));
      const std::size_t first = bin_of(low), last = bin_of(high), side = std::size_t(side_);
      for (std::size_t y = first / side; y <= last / side; ++y)
        for (std::size_t x = first % side; x <= last % side; ++x) {
          const std::size_t bin = y * side + x;
          if (writing)
            member_[row_[bin + 1]++] = std::uint32_t(i);
          else
            ++row_[bin + 2];
        }
    }
    for (std::size_t i = 1; !writing && i < row_.size(); ++i) row_[i] += row_[i - 1];
    if (!writing) member_.resize(row_.back());
  }
}

std::size_t ClosedSurface::bin_of(glm::dvec2 point) const {
  const glm::dvec2 at = glm::clamp((point - least_) * per_bin_, 0.0, double(side_ - 1));
  return std::size_t(at.y) * std::size_t(side_) + std::size_t(at.x);
}

int ClosedSurface::winding(glm::dvec3 point) const {
  const glm::dvec2 p = seen_along_x(point);
  const std::size_t bin = bin_of(p);
  int number = 0;
  for (std::uint32_t k = row_[bin]; k < row_[bin + 1]; ++k) {
    const auto& [a, b, c] = triangles_[member_[k]];
    const bool left = left_of(seen_along_x(a), seen_along_x(b), p);
    if (left != left_of(seen_along_x(b), seen_along_x(c), p) ||
        left != left_of(seen_along_x(c), seen_along_x(a), p))
      continue;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    // n . (point + s x - a) = 0 gives the distance s along the ray.
    if (normal.x != 0 && glm::dot(normal, a - point) / normal.x > 0) number += left ? 1 : -1;
  }
  return number;
}

double ClosedSurface::distance(glm::vec3 point) const {
  const double size = glm::distance(glm::dvec3(point), glm::dvec3(search_.closest(point).point));
  return winding(glm::dvec3(point)) > 0 ? -size : size;
}

}  // namespace pelage
