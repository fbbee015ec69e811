#include "harness/springs/model/network.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "harness/error.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage::springs {
namespace {

using Corners = std::vector<glm::uvec3>;  // indices of the three sticks of each triangle

// Returns the undirected edges of the triangles in ascending order, each edge once.
std::vector<glm::uvec2> unique_edges(const Corners& corners) {
  std::vector<glm::uvec2> edges;
  edges.reserve(3 * corners.size());
  for (const glm::uvec3& t : corners)
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t a = t[c], b = t[(c + 1) % 3];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
    }
  std::ranges::sort(edges, [](glm::uvec2 a, glm::uvec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<glm::uvec2> edges_of(Kind kind, const Corners& corners) {
  if (!kind.edges) return {};
  if (!kind.separable) return unique_edges(corners);
  std::vector<glm::uvec2> edges;
  edges.reserve(3 * corners.size());
  for (const glm::uvec3& t : corners)
    for (int c = 0; c < 3; ++c) edges.push_back({t[c], t[(c + 1) % 3]});
  return edges;
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const glm::uvec3& t : mesh.triangle) {
    const glm::dvec3 a(mesh.position[t.x]), b(mesh.position[t.y]), c(mesh.position[t.z]);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

glm::dvec3 rest_top(const SpringNetwork& network, std::uint32_t stick) {
  return glm::dvec3(network.mass[stick]) + glm::dvec3(network.length * network.normal[stick]);
}

}  // namespace

SpringNetwork build(Kind kind, const Mesh& mesh, float length, Vertices vertices, Gusts gusts) {
  if (mesh.triangle.empty())
    throw InputError(fmt::format("{}: the mesh has no triangle; a topology needs at least one", mesh.name));
  if (!(length > 0) || !std::isfinite(length))
    throw InputError(fmt::format("topology: the fur length is {} R; it must be finite and above 0", length));
  const Skin skin = weld(mesh);

  SpringNetwork network;
  network.kind = kind;
  Corners corners;
  if (kind.separable) {
    for (const glm::uvec3& t : mesh.triangle) {
      const auto first = std::uint32_t(network.copy.size());
      corners.push_back({first, first + 1, first + 2});
      network.copy.insert(network.copy.end(), {t.x, t.y, t.z});
    }
  } else if (vertices == Vertices::copies) {
    corners = mesh.triangle;
    for (std::uint32_t v = 0; v < mesh.position.size(); ++v) network.copy.push_back(v);
  } else {
    corners = skin.triangle;
    network.copy = skin.first_copy;
  }

  const std::size_t sticks = network.copy.size();
  network.mass.resize(2 * sticks);
  for (std::size_t i = 0; i < sticks; ++i) {
    const glm::vec3 base = mesh.position[network.copy[i]];
    const glm::vec3 normal(skin.normal[mesh.weld[network.copy[i]]]);
    network.normal.push_back(normal);
    network.point.push_back(mesh.weld[network.copy[i]]);
    network.gust_at.push_back(base);
    network.mass[i] = base;
    network.mass[sticks + i] = base + length * normal;
    network.spring.push_back({std::uint32_t(i), std::uint32_t(sticks + i)});
    network.rest.push_back(length);
  }
  network.length = length;
  network.stick_area = area_of(mesh) / double(sticks);
  if (kind.separable && gusts == Gusts::triangles)
    for (const glm::uvec3& t : corners) {
      const glm::vec3 centroid = (network.mass[t.x] + network.mass[t.y] + network.mass[t.z]) / 3.0f;
      for (int c = 0; c < 3; ++c) network.gust_at[t[c]] = centroid;
    }
  const auto shift = std::uint32_t(sticks);
  for (const glm::uvec2 edge : edges_of(kind, corners)) {
    network.spring.push_back(edge + shift);
    network.rest.push_back(float(glm::distance(rest_top(network, edge.x), rest_top(network, edge.y))));
  }
  network.corner = std::move(corners);
  return network;
}

// hit() tests every triangle, because a scene has at most one ray, that of its poke. Building the search tree
// of harness/mesh/search.hpp would take 50 times as long.
std::optional<std::size_t> hit(const Mesh& mesh, glm::dvec3 origin, glm::dvec3 direction) {
  std::optional<std::size_t> found;
  double nearest = std::numeric_limits<double>::infinity();
  // Each triangle is tested by the algorithm of Moeller and Trumbore 1997.
  for (std::size_t f = 0; f < mesh.triangle.size(); ++f) {
    const glm::uvec3 t = mesh.triangle[f];
    const glm::dvec3 a(mesh.position[t.x]), u = glm::dvec3(mesh.position[t.y]) - a,
                                            v = glm::dvec3(mesh.position[t.z]) - a;
    const glm::dvec3 across = glm::cross(direction, v), from = origin - a, turned = glm::cross(from, u);
    const double volume = glm::dot(u, across);
    if (volume == 0) continue;
    const double x = glm::dot(from, across) / volume, y = glm::dot(direction, turned) / volume,
                 distance = glm::dot(v, turned) / volume;
    if (x < 0 || y < 0 || x + y > 1 || distance < 0 || distance >= nearest) continue;
    nearest = distance;
    found = f;
  }
  return found;
}

Degrees degrees(const SpringNetwork& network) {
  std::vector<int> count(network.mass.size(), 0);
  for (const glm::uvec2 spring : network.spring) ++count[spring.x], ++count[spring.y];
  const auto tops = std::span(count).subspan(network.sticks());
  Degrees found{*std::ranges::min_element(tops), *std::ranges::max_element(tops), 0};
  for (const int degree : tops) found.mean += double(degree);
  found.mean /= double(tops.size());
  return found;
}

}  // namespace pelage::springs
