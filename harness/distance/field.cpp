#include "harness/distance/field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>

#include "harness/distance/closed_surface.hpp"
#include "harness/error.hpp"
#include "harness/hash.hpp"
#include "harness/mesh/disk_cache.hpp"

namespace pelage {
namespace {

constexpr int margin = 2;  // cells beyond the bounding box

}  // namespace

DistanceField distance_field(const std::shared_ptr<const Mesh>& mesh, int cells) {
  if (cells < 4 || cells > 256)
    throw InputError(fmt::format("cells of the body's distance field: {}; it must be from 4 to 256", cells));
  const ClosedSurface surface(mesh);
  glm::vec3 least(mesh->position.front()), most = least;
  for (const glm::vec3& p : mesh->position) least = glm::min(least, p), most = glm::max(most, p);
  const glm::vec3 size = most - least;
  DistanceField f;
  f.mesh = mesh->hash;
  f.cell = std::max({size.x, size.y, size.z, 1e-6f}) / float(cells);
  f.nodes = glm::ivec3(glm::ceil(size / f.cell)) + 1 + 2 * margin;
  f.origin = (least + most) / 2.0f - 0.5f * f.cell * glm::vec3(f.nodes - 1);
  f.distance.reserve(std::size_t(f.nodes.x) * std::size_t(f.nodes.y) * std::size_t(f.nodes.z));
  for (int z = 0; z < f.nodes.z; ++z)
    for (int y = 0; y < f.nodes.y; ++y)
      for (int x = 0; x < f.nodes.x; ++x)
        f.distance.push_back(float(surface.distance(f.origin + f.cell * glm::vec3(x, y, z))));
  return f;
}

std::shared_ptr<const DistanceField> kept_distance_field(const std::shared_ptr<const Mesh>& mesh, int cells) {
  if (mesh->hash.empty()) return std::make_shared<const DistanceField>(distance_field(mesh, cells));
  const std::string name =
      fmt::format("field-{}", Hash().text(mesh->hash).number(std::uint64_t(cells)).hex());
  const auto parts = [](const auto& store, auto& f) {
    return store(f.mesh) && store(f.nodes) && store(f.origin) && store(f.cell) && store(f.distance);
  };
  return std::make_shared<const DistanceField>(
      cached<DistanceField>(cache_folder() / "fields" / name, "pelage field 1\n", std::uintmax_t(64) << 20,
                            parts, [&] { return distance_field(mesh, cells); }));
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

}  // namespace pelage
