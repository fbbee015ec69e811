#include <algorithm>
#include <cmath>

#include "harness/prepare/picture_map.hpp"
#include "harness/prepare/strands.hpp"

namespace pelage {
namespace {

/// Returns the map's value at the UV of the first vertex of each surface point; nothing without a map.
std::vector<float> at_points(const Mesh& mesh, const Skin& skin, const LumaMap& map) {
  std::vector<float> values;
  if (map.constant()) return values;
  for (const std::uint32_t copy : skin.first_copy) values.push_back(float(map.at(glm::dvec2(mesh.uv[copy]))));
  return values;
}

/// Returns the map's value at the centroid, in UV, of each triangle; nothing without a map.
std::vector<float> at_triangles(const Mesh& mesh, const LumaMap& map) {
  std::vector<float> values;
  if (map.constant()) return values;
  for (const glm::uvec3& t : mesh.triangle) {
    const glm::dvec2 sum = glm::dvec2(mesh.uv[t.x]) + glm::dvec2(mesh.uv[t.y]) + glm::dvec2(mesh.uv[t.z]);
    values.push_back(float(map.at(sum / 3.0)));
  }
  return values;
}

}  // namespace

Style make_style(const Mesh& mesh, const Skin& skin, const Scene& scene) {
  const LumaMap length(scene.fur.length_map, "fur.length_map"),
      density(scene.fur.density_map, "fur.density_map");
  Style style;
  style.length = at_triangles(mesh, length);
  for (float& share : style.length) share = std::max(share, least_length_share);
  style.comb = at_points(mesh, skin, LumaMap(scene.fur.comb_map, "fur.comb_map"));
  style.curl_radius = at_points(mesh, skin, LumaMap(scene.curl.radius_map, "curl.radius_map"));
  style.curl_turns = at_points(mesh, skin, LumaMap(scene.curl.turns_map, "curl.turns_map"));
  for (float& share : style.curl_turns) share = std::rint(share * float(turn_steps)) / float(turn_steps);
  style.density = {density.width(), density.height(), density.luma()};
  return style;
}

float strand_length(const FurScene& fur, const Style& style, std::size_t strand) {
  return fur.length * share_of(style.length, strand);
}

float most_curl_radius(const CurlScene& curl, const Style& style) {
  if (style.curl_radius.empty()) return curl.radius;
  return curl.radius * *std::max_element(style.curl_radius.begin(), style.curl_radius.end());
}

}  // namespace pelage
