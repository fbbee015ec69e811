#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "harness/error.hpp"
#include "harness/prepare/random.hpp"
#include "harness/strands/groom/steps.hpp"

namespace pelage::strands {
namespace {

constexpr float mask_limit = 0.5f;
constexpr float above_zero = std::numeric_limits<float>::denorm_min();
constexpr std::uint32_t sample_stream = 0x726f6f76;  // an independent sequence of Random
constexpr std::size_t samples = 1 << 18;             // least number of points that require_place() tests

/// Whether the region of the layer may contain a point of the triangle.
bool region_reaches(const StrandLayerScene& layer, const Mesh& mesh, std::uint32_t face) {
  const glm::uvec3 t = mesh.triangle[face];
  const std::array<glm::dvec3, 3> corner{mesh.position[t.x], mesh.position[t.y], mesh.position[t.z]};
  const glm::dvec3 centre(layer.region_centre), middle = (corner[0] + corner[1] + corner[2]) / 3.0;
  double farthest = 0, size = 0;
  for (const glm::dvec3& p : corner) {
    farthest = std::max(farthest, glm::distance(p, centre));
    size = std::max(size, glm::distance(p, middle));
  }
  // A triangle lies outside of the ball only if one of its corners does.
  if (layer.region_outside) return farthest >= double(layer.region_radius);
  return glm::distance(middle, centre) <= double(layer.region_radius) + size;
}

bool in_region(const StrandLayerScene& layer, glm::dvec3 point) {
  const bool inside = glm::distance(point, glm::dvec3(layer.region_centre)) <= double(layer.region_radius);
  return inside != layer.region_outside;
}

}  // namespace

LayerMaps::LayerMaps(const StrandLayerScene& of, const std::string& called)
    : layer(of),
      name(called),
      mask(of.mask, called + ".mask"),
      density_map(of.density_map, called + ".density_map"),
      length(of.length_map, called + ".length_map"),
      width(of.width_map, called + ".width_map"),
      stiffness(of.stiffness_map, called + ".stiffness_map"),
      response(of.response_map, called + ".response_map"),
      curvature(of.curvature_map, called + ".curvature_map"),
      twist(of.twist_map, called + ".twist_map"),
      most_density_(density_map.most()) {
  if (!of.comb_map.empty()) comb.emplace(map_of(of.comb_map, called + ".comb_map"));
}

std::vector<LayerMaps::Condition> LayerMaps::conditions() const {
  std::vector<Condition> list;
  if (layer.region_radius > 0)
    list.push_back(
        {"region_radius",
         {},
         [this](const Mesh& mesh, const Root& root) {
           return in_region(layer, position_of(mesh, root)) ? 1.0 : 0.0;
         },
         [this](const Mesh& mesh, std::uint32_t face) { return region_reaches(layer, mesh, face); }});
  const auto add = [&](const char* key, const std::filesystem::path& file, const LumaMap& map, float least,
                       const std::function<double(double)>& density) {
    if (map.constant()) return;
    list.push_back(
        {key, file,
         [&map, density](const Mesh& mesh, const Root& root) { return density(map.at(uv_of(mesh, root))); },
         [&map, least](const Mesh& mesh, std::uint32_t face) {
           const glm::uvec3 t = mesh.triangle[face];
           const glm::vec2 a = mesh.uv[t.x], b = mesh.uv[t.y], c = mesh.uv[t.z];
           return map.reaches(glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), least);
         }});
  };
  const auto some = [](double v) { return v > 0 ? 1.0 : 0.0; };
  add("mask", layer.mask, mask, mask_limit, [](double v) { return v >= double(mask_limit) ? 1.0 : 0.0; });
  add("density_map", layer.density_map, density_map, above_zero, [](double v) { return v; });
  add("length_map", layer.length_map, length, above_zero, some);
  add("width_map", layer.width_map, width, above_zero, some);
  return list;
}

double LayerMaps::density(const Mesh& mesh, const Root& root) const {
  if (layer.region_radius > 0 && !in_region(layer, position_of(mesh, root))) return 0;
  if (mask.constant() && density_map.constant() && length.constant() && width.constant()) return 1;
  const glm::dvec2 uv = uv_of(mesh, root);
  if (mask.at(uv) < double(mask_limit) || !(length.at(uv) > 0) || !(width.at(uv) > 0)) return 0;
  return density_map.constant() ? 1 : density_map.at(uv) / most_density_;
}

std::vector<bool> LayerMaps::bare(const Mesh& mesh) const {
  const std::vector<Condition> all = conditions();
  std::vector<bool> result(mesh.triangle.size());
  for (std::uint32_t face = 0; face < mesh.triangle.size(); ++face)
    result[face] = !std::ranges::all_of(all, [&](const Condition& c) { return c.possible(mesh, face); });
  return result;
}

void LayerMaps::require_place(const Mesh& mesh) const {
  const std::vector<Condition> all = conditions();
  if (all.empty()) return;
  const std::vector<bool> without = bare(mesh);
  const auto open = std::size_t(std::ranges::count(without, false));
  const std::size_t per_face = 1 + samples / std::max<std::size_t>(open, 1);
  const Random random(layer.seed, sample_stream);
  std::size_t met = 0;  // largest number of conditions, in their order, that a point meets
  for (std::uint32_t face = 0; face < mesh.triangle.size() && met < all.size(); ++face) {
    // Triangles without strands are tested at one point each, to find the condition that no point meets.
    for (std::size_t i = 0; i < (without[face] ? 1 : per_face) && met < all.size(); ++i) {
      double a = random.uniform(face * per_face + i, 0), b = random.uniform(face * per_face + i, 1);
      if (a + b > 1) a = 1 - a, b = 1 - b;
      const Root root{face, {float(a), float(b)}};
      std::size_t k = 0;
      while (k < all.size() && all[k].density(mesh, root) > 0) ++k;
      met = std::max(met, k);
    }
  }
  if (met == all.size()) return;
  const Condition& last = all[met];
  std::string others;
  for (std::size_t k = 0; k < met; ++k) others += fmt::format("{}{}", k == 0 ? "" : " and ", all[k].key);
  throw InputError(fmt::format("{}.{}: {}leaves no place for strands on {}{}", name, last.key,
                               last.file.empty() ? "" : last.file.string() + ": ", mesh.name,
                               others.empty() ? "" : ", together with " + others));
}

}  // namespace pelage::strands
