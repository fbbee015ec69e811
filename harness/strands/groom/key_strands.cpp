#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/error.hpp"
#include "harness/prepare/strands.hpp"
#include "harness/strands/groom/steps.hpp"

namespace pelage::strands {
namespace {

constexpr std::uint32_t none = 0xffffffff;
// A direction of the comb map below this length is taken for grey. Grey of 8 bits has at most the length
// sqrt(3) / 255.
constexpr double least_direction = 1.0 / 32;
constexpr double least_cosine = 1e-6;                    // keeps the rounded direction at rest above the skin
constexpr float least_length = 1e-4f, most_length = 10;  // R, the limits of Chain::length

/// Returns the direction that leans from the normal n by `angle` (radians) towards the projection of `comb`
/// onto the surface. Returns n if the projection is 0.
glm::dvec3 leaning(glm::dvec3 n, glm::dvec3 comb, double angle) {
  const glm::dvec3 flat = tangential(comb, n);
  const double length = glm::length(flat);
  if (length < 1e-6 * glm::length(comb) || length == 0) return n;
  return std::max(std::cos(angle), least_cosine) * n + std::sin(angle) / length * flat;
}

/// The comb map's direction at a vertex, in the object's frame. Its length is that of the map's vector.
glm::dvec3 combed(const PictureMap& comb, const SurfaceTangents& tangents, glm::dvec3 n, glm::dvec2 uv,
                  std::size_t vertex) {
  const glm::dvec4 colour(comb.at(uv));
  const auto unit = [](glm::dvec3 v) { return glm::length(v) > 0 ? glm::normalize(v) : v; };
  return (2 * colour.x - 1) * unit(tangential(glm::dvec3(tangents.t[vertex]), n)) +
         (2 * colour.y - 1) * unit(tangential(glm::dvec3(tangents.b[vertex]), n)) + (2 * colour.z - 1) * n;
}

/// The mean values of a surface point's copies.
struct Point {
  double length = 0, stiffness = 0;
  glm::dvec3 comb{0};
  glm::dvec2 uv{0};  ///< UV of one of the copies
  int copies = 0;
};

}  // namespace

KeyStrands key_strands(const Mesh& mesh, const Skin& skin, const LayerMaps& maps,
                       const std::vector<Root>& roots) {
  KeyStrands result;
  result.index.assign(mesh.welded, none);
  for (const Root& root : roots)
    for (int corner = 0; corner < 3; ++corner) result.index[mesh.weld[mesh.triangle[root.face][corner]]] = 0;
  std::vector<Point> points(mesh.welded);
  const SurfaceTangents tangents = maps.comb ? surface_tangents(mesh, skin) : SurfaceTangents{};
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    if (result.index[mesh.weld[v]] == none) continue;
    Point& point = points[mesh.weld[v]];
    const glm::dvec2 uv(mesh.uv[v]);
    point.length += maps.length.at(uv);
    point.stiffness += maps.stiffness.at(uv);
    if (maps.comb) point.comb += combed(*maps.comb, tangents, skin.normal[mesh.weld[v]], uv, v);
    point.uv = uv;
    ++point.copies;
  }
  const StrandLayerScene& layer = maps.layer;
  const double lean = double(layer.lean) * std::numbers::pi / 180;
  for (std::uint32_t w = 0; w < mesh.welded; ++w) {
    if (result.index[w] == none) continue;
    result.index[w] = std::uint32_t(result.keys.size());
    const Point& point = points[w];
    const glm::dvec3 n = skin.normal[w];
    glm::dvec3 comb(layer.comb);
    double angle = lean;
    if (maps.comb) {
      comb = point.comb / double(point.copies);
      const double length = glm::length(comb), upright = std::clamp(glm::dot(comb, n) / length, 0.0, 1.0);
      if (!(length > least_direction) || glm::dot(comb, n) < -0.999 * length)
        throw InputError(
            fmt::format("{}.comb_map: {}: the direction at UV ({:.3f}, {:.3f}) is zero or points into the "
                        "skin, but the layer has strands there",
                        maps.name, layer.comb_map.string(), point.uv.x, point.uv.y));
      angle = lean * std::acos(upright) / (std::numbers::pi / 2);
    }
    KeyStrand key;
    key.root = glm::vec3(skin.position[w]);
    key.normal = glm::vec3(n);
    key.first = key.second = key.rest = glm::vec3(glm::normalize(leaning(n, comb, angle)));
    result.keys.push_back(key);
    Chain chain;
    chain.root = key.root;
    chain.rest = key.rest;
    chain.normal = key.normal;
    chain.length =
        std::clamp(float(double(layer.length) * point.length / point.copies), least_length, most_length);
    chain.stiffness_first = chain.stiffness_second =
        float(double(layer.stiffness) * point.stiffness / point.copies);
    result.chains.push_back(chain);
    result.point.push_back(w);
  }
  return result;
}

}  // namespace pelage::strands
