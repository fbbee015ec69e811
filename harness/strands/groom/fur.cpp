#include "harness/strands/groom/fur.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "harness/error.hpp"
#include "harness/prepare/random.hpp"
#include "harness/strands/groom/roots.hpp"

namespace pelage::strands {
namespace {

constexpr std::uint32_t length_stream = 71, colour_stream = 72;  // independent sequences of Random

void check(const FurLayer& layer) {
  const auto in_range = [](const char* what, float value, float least, float most) {
    if (!(value >= least && value <= most))
      throw InputError(fmt::format("{}: {}; it must be from {} to {}", what, value, least, most));
  };
  in_range("length of the strands", layer.length, 1e-4f, 10);
  in_range("spread of the lengths", layer.length_spread, 0, 0.95f);
  in_range("width of the strands", layer.width, 1e-6f, 1);
  in_range("lean of the strands", layer.lean, 0, 90);
  in_range("spread of the colours", layer.colour_spread, 0, 1);
  for (int axis = 0; axis < 3; ++axis) {
    in_range("colour of the strands", layer.colour[axis], 0, 1);
    in_range("direction of the comb", layer.comb[axis], -1e6f, 1e6f);
  }
}

/// Returns the unit normal of every surface point: the mean of the normals of its triangles, weighted by
/// their areas.
std::vector<glm::dvec3> normals_of(const Mesh& mesh) {
  std::vector<glm::dvec3> normals(mesh.welded, glm::dvec3(0));
  for (const glm::uvec3& t : mesh.triangle) {
    const glm::dvec3 a(mesh.position[t.x]), b(mesh.position[t.y]), c(mesh.position[t.z]);
    const glm::dvec3 n = glm::cross(b - a, c - a);
    for (int corner = 0; corner < 3; ++corner) normals[mesh.weld[t[corner]]] += n;
  }
  for (glm::dvec3& n : normals) n = glm::length(n) > 0 ? glm::normalize(n) : glm::dvec3(0, 1, 0);
  return normals;
}

/// Returns the direction that leans from the normal n by `angle` (radians) towards the projection of `comb`
/// onto the surface. Returns n if the projection is 0.
glm::dvec3 leaning(glm::dvec3 n, glm::dvec3 comb, double angle) {
  const glm::dvec3 flat = comb - glm::dot(comb, n) * n;
  const double length = glm::length(flat);
  if (length < 1e-6 * glm::length(comb) || length == 0) return n;
  return std::cos(angle) * n + std::sin(angle) / length * flat;
}

std::uint8_t byte_of(double value) {
  return std::uint8_t(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

}  // namespace

Fur grow(const Mesh& mesh, const FurLayer& layer) {
  check(layer);
  Fur fur;
  const std::vector<glm::dvec3> normals = normals_of(mesh);
  fur.keys.resize(mesh.welded);
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    KeyStrand& key = fur.keys[mesh.weld[v]];
    const glm::dvec3 n = normals[mesh.weld[v]];
    key.root = mesh.position[v];
    key.normal = glm::vec3(n);
    key.first = key.second = key.rest =
        glm::vec3(leaning(n, glm::dvec3(layer.comb), double(layer.lean) * std::numbers::pi / 180));
  }
  std::vector<Root> roots = scatter_roots(
      mesh, [](const Root&) { return 1.0; }, layer.count, layer.seed);
  std::stable_sort(roots.begin(), roots.end(), [](const Root& a, const Root& b) { return a.face < b.face; });
  const Random lengths(layer.seed, length_stream), colours(layer.seed, colour_stream);
  fur.strands.reserve(roots.size());
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const glm::uvec3 corners = mesh.triangle[roots[i].face];
    KeyedStrand s;
    for (int k = 0; k < 3; ++k) s.key[std::size_t(k)] = mesh.weld[corners[k]];
    s.weight = roots[i].weight;
    s.length = float(double(layer.length) * (1 + double(layer.length_spread) * lengths.symmetric(i)));
    s.width = layer.width;
    const double brightness = 1 + double(layer.colour_spread) * colours.symmetric(i);
    for (int c = 0; c < 3; ++c) s.colour[std::size_t(c)] = byte_of(brightness * double(layer.colour[c]));
    fur.strands.push_back(s);
  }
  return fur;
}

}  // namespace pelage::strands
