#include "harness/topology/topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/error.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage::topology {
namespace {

using Corners = std::vector<glm::uvec3>;  // sticks of each triangle

// The undirected edges of the triangles, each once, in ascending order.
std::vector<glm::uvec2> unique_edges(const Corners& corners) {
  std::vector<glm::uvec2> edges;
  edges.reserve(3 * corners.size());
  for (const glm::uvec3& t : corners)
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t a = t[c], b = t[(c + 1) % 3];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
    }
  std::sort(edges.begin(), edges.end(),
            [](glm::uvec2 a, glm::uvec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<glm::uvec2> edges_of(Kind kind, const Corners& corners) {
  if (!has_prisms(kind)) return {};
  if (!separable(kind)) return unique_edges(corners);
  std::vector<glm::uvec2> edges;
  edges.reserve(3 * corners.size());
  for (const glm::uvec3& t : corners)
    for (int c = 0; c < 3; ++c) edges.push_back({t[c], t[(c + 1) % 3]});
  return edges;
}

}  // namespace

std::string_view name(Kind kind) {
  switch (kind) {
    case Kind::sticks:
      return "sticks";
    case Kind::prisms:
      return "prisms";
    case Kind::separable_sticks:
      return "separable-sticks";
    case Kind::separable_prisms:
      break;
  }
  return "separable-prisms";
}

Kind kind_of(const std::string& wanted) {
  for (const Kind kind : kinds)
    if (name(kind) == wanted) return kind;
  throw InputError(
      fmt::format("topology {}: none of sticks, prisms, separable-sticks, separable-prisms", wanted));
}

Topology build(Kind kind, const Mesh& mesh, float length, Vertices vertices) {
  if (mesh.triangle.empty()) throw InputError(fmt::format("{}: no triangle to stand a stick on", mesh.name));
  if (!(length > 0) || !std::isfinite(length))
    throw InputError(fmt::format("topology: a fur length of {} R; it has to be finite and above 0", length));
  const Skin skin = weld(mesh);

  Topology topology;
  topology.kind = kind;
  Corners corners;
  if (separable(kind)) {
    for (const glm::uvec3& t : mesh.triangle) {
      const auto first = std::uint32_t(topology.copy.size());
      corners.push_back({first, first + 1, first + 2});
      topology.copy.insert(topology.copy.end(), {t.x, t.y, t.z});
    }
  } else if (vertices == Vertices::copies) {
    corners = mesh.triangle;
    for (std::uint32_t v = 0; v < mesh.position.size(); ++v) topology.copy.push_back(v);
  } else {
    corners = skin.triangle;
    topology.copy = skin.first_copy;
  }

  const std::size_t sticks = topology.copy.size();
  topology.mass.resize(2 * sticks);
  for (std::size_t i = 0; i < sticks; ++i) {
    const glm::vec3 base = mesh.position[topology.copy[i]];
    const glm::vec3 normal(skin.normal[mesh.weld[topology.copy[i]]]);
    topology.normal.push_back(normal);
    topology.mass[i] = base;
    topology.mass[sticks + i] = base + length * normal;
    topology.spring.push_back({std::uint32_t(i), std::uint32_t(sticks + i)});
  }
  const auto shift = std::uint32_t(sticks);
  for (const glm::uvec2 edge : edges_of(kind, corners)) topology.spring.push_back(edge + shift);
  return topology;
}

Degrees degrees(const Topology& topology) {
  std::vector<int> count(topology.mass.size(), 0);
  for (const glm::uvec2 spring : topology.spring) ++count[spring.x], ++count[spring.y];
  const auto tops = std::span(count).subspan(topology.sticks());
  Degrees found{*std::min_element(tops.begin(), tops.end()), *std::max_element(tops.begin(), tops.end()), 0};
  for (const int degree : tops) found.mean += double(degree);
  found.mean /= double(tops.size());
  return found;
}

}  // namespace pelage::topology
