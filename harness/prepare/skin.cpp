#include "harness/prepare/skin.hpp"

#include <glm/geometric.hpp>

#include "harness/parallel.hpp"

namespace pelage {
namespace {

glm::dvec3 unit_or(glm::dvec3 v, glm::dvec3 fallback) {
  const double length = glm::length(v);
  return length > 1e-30 ? v / length : fallback;
}

bool corner_again(glm::uvec3 t, int corner) {
  return (corner > 0 && t[corner] == t[0]) || (corner > 1 && t[corner] == t[1]);
}

}  // namespace

glm::dvec3 tangential(glm::dvec3 v, glm::dvec3 n) {
  return v - n * glm::dot(v, n);
}

glm::dvec3 any_tangent(glm::dvec3 n) {
  const glm::dvec3 axis = n.x * n.x < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(tangential(axis, n));
}

Skin weld(const Mesh& mesh) {
  Skin s;
  const std::size_t points = mesh.welded, faces = mesh.triangle.size();
  s.position.resize(points);
  s.first_copy.resize(points);
  for (std::size_t v = mesh.position.size(); v-- > 0;) {
    s.position[mesh.weld[v]] = mesh.position[v];
    s.first_copy[mesh.weld[v]] = std::uint32_t(v);
  }

  s.triangle.reserve(faces);
  s.area.reserve(faces);
  s.normal.assign(points, glm::dvec3(0));
  s.row.assign(points + 1, 0);
  for (const glm::uvec3& copy : mesh.triangle) {
    const glm::uvec3 t(mesh.weld[copy.x], mesh.weld[copy.y], mesh.weld[copy.z]);
    const glm::dvec3 o = s.position[t.x];
    const glm::dvec3 twice = glm::cross(s.position[t.y] - o, s.position[t.z] - o);
    s.triangle.push_back(t);
    s.area.push_back(0.5 * glm::length(twice));
    s.face_normal.push_back(twice);
    for (int c = 0; c < 3; ++c) {
      if (corner_again(t, c)) continue;
      s.normal[t[c]] += twice;
      ++s.row[t[c] + 1];
    }
  }
  for (glm::dvec3& n : s.normal) n = unit_or(n, {0, 1, 0});
  for (std::size_t f = 0; f < faces; ++f) {
    const glm::uvec3 t = s.triangle[f];
    s.face_normal[f] =
        unit_or(s.face_normal[f], unit_or(s.normal[t.x] + s.normal[t.y] + s.normal[t.z], {0, 1, 0}));
  }

  for (std::size_t w = 0; w < points; ++w) s.row[w + 1] += s.row[w];
  s.face.resize(s.row.back());
  std::vector<std::uint32_t> next(s.row.begin(), s.row.end() - 1);
  for (std::size_t f = 0; f < faces; ++f)
    for (int c = 0; c < 3; ++c)
      if (!corner_again(s.triangle[f], c)) s.face[next[s.triangle[f][c]]++] = std::uint32_t(f);
  return s;
}

std::vector<glm::dvec3> smooth_tangents(const Skin& s, std::vector<glm::dvec3> field, int iterations,
                                        bool unit) {
  std::vector<glm::dvec3> next(field.size());
  // The corners of the triangles around each point, in a row, which is faster than to find them again.
  std::vector<glm::uvec3> around;
  around.reserve(s.face.size());
  for (const std::uint32_t face : s.face) around.push_back(s.triangle[face]);
  for (int i = 0; i < iterations; ++i) {
    for_each_index(field.size(), 4096, [&](std::size_t w) {
      glm::dvec3 sum(0);
      for (std::uint32_t k = s.row[w]; k < s.row[w + 1]; ++k)
        for (int c = 0; c < 3; ++c) sum += field[around[k][c]];
      const double count = 3.0 * (s.row[w + 1] - s.row[w]);
      const glm::dvec3 flat = tangential(count > 0 ? sum / count : field[w], s.normal[w]);
      const double length = glm::length(flat);
      if (!unit)
        next[w] = flat;
      else
        next[w] = length > 1e-9 ? flat / length : field[w];
    });
    field.swap(next);
  }
  return field;
}

}  // namespace pelage
