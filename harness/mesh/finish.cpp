#include "harness/mesh/finish.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "harness/hash.hpp"
#include "harness/mesh/geometry.hpp"

namespace pelage {
namespace {

// The bits of a coordinate in [-1,1], 21 of them, with two zeros between neighbours.
std::uint64_t spread(double coordinate) {
  std::uint64_t bits = std::uint64_t(std::clamp((coordinate * 0.5 + 0.5) * 2097151.0, 0.0, 2097151.0));
  bits = (bits | bits << 32) & 0x1f00000000ffffu;
  bits = (bits | bits << 16) & 0x1f0000ff0000ffu;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
  return (bits | bits << 2) & 0x1249249249249249u;
}

std::uint64_t morton(glm::dvec3 p) {
  return spread(p.x) | spread(p.y) << 1 | spread(p.z) << 2;
}

// The order that sorts `points` along the curve; ties keep their place.
std::vector<std::uint32_t> morton_order(const std::vector<glm::dvec3>& points) {
  std::vector<std::uint64_t> key(points.size());
  std::transform(points.begin(), points.end(), key.begin(), morton);
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key[a] < key[b]; });
  return order;
}

std::vector<glm::dvec3> normalised(const Surface& surface, glm::dvec3 rotation) {
  const Sphere sphere = bounding_sphere(surface.point);
  const glm::dmat3 matrix = rotation_matrix(rotation);
  std::vector<glm::dvec3> points;
  points.reserve(surface.point.size());
  for (const glm::dvec3& p : surface.point) points.push_back(matrix * ((p - sphere.centre) / sphere.radius));
  return points;
}

struct Box {
  glm::dvec2 low{std::numeric_limits<double>::max()}, high{-std::numeric_limits<double>::max()};
  double side() const { return std::max(high.x - low.x, high.y - low.y); }
};

glm::dvec2 turned(glm::dvec2 p, double degrees) {
  const double c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

Box box_of(const std::vector<Surface::Corners>& uv, double degrees) {
  Box box;
  for (const auto& corners : uv) {
    for (const glm::dvec2& p : corners) {
      const glm::dvec2 q = turned(p, degrees);
      box.low = glm::min(box.low, q), box.high = glm::max(box.high, q);
    }
  }
  return box;
}

// Moves a map into the unit square, turned so that it is as large as can be there, with a margin of two
// texels of a 256 mask around it.
void fit_uv(std::vector<Surface::Corners>& uv) {
  double best = 0, least = std::numeric_limits<double>::max();
  for (double degrees = 0; degrees < 90; degrees += 2)
    if (const double side = box_of(uv, degrees).side(); side < least * (1 - 1e-6))
      least = side, best = degrees;
  const Box box = box_of(uv, best);
  constexpr double margin = 2.0 / 256;
  const double scale = (1 - 2 * margin) / box.side();
  const glm::dvec2 shift = glm::dvec2(0.5) - scale * 0.5 * (box.low + box.high);
  for (auto& corners : uv)
    for (glm::dvec2& p : corners) p = turned(p, best) * scale + shift;
}

// A file's own map may lie within the unit square already: a texture of the user's fits it then.
bool fits(const std::vector<Surface::Corners>& uv) {
  const Box box = box_of(uv, 0);
  return box.low.x >= 0 && box.low.y >= 0 && box.high.x <= 1 && box.high.y <= 1;
}

// Area-weighted over the UV square for maps that repeat, whose axes differ; sqrt(surface / UV area) for
// others.
glm::vec2 length_per_uv(const std::vector<glm::dvec3>& point, const Surface& surface,
                        const std::vector<Surface::Corners>& uv) {
  double area = 0, uv_area = 0;
  glm::dvec2 length(0);
  for (std::size_t f = 0; f < surface.triangle.size(); ++f) {
    const auto [a, b, c] = surface.triangle[f];
    const glm::dvec3 e1 = point[b] - point[a], e2 = point[c] - point[a];
    const glm::dvec2 d1 = uv[f][1] - uv[f][0], d2 = uv[f][2] - uv[f][0];
    const double twice = d1.x * d2.y - d1.y * d2.x;
    area += 0.5 * glm::length(glm::cross(e1, e2));
    uv_area += 0.5 * std::abs(twice);
    length += 0.5 * glm::dvec2(glm::length(e1 * d2.y - e2 * d1.y), glm::length(e2 * d1.x - e1 * d2.x));
  }
  return surface.periodic_uv ? glm::vec2(length / uv_area) : glm::vec2(float(std::sqrt(area / uv_area)));
}

}  // namespace

glm::dmat3 rotation_matrix(glm::dvec3 degrees) {
  const glm::dvec3 a = glm::radians(degrees), c = glm::cos(a), s = glm::sin(a);
  const glm::dmat3 x(1, 0, 0, 0, c.x, s.x, 0, -s.x, c.x);
  const glm::dmat3 y(c.y, 0, -s.y, 0, 1, 0, s.y, 0, c.y);
  const glm::dmat3 z(c.z, s.z, 0, -s.z, c.z, 0, 0, 0, 1);
  return z * y * x;
}

std::string content_hash(const Mesh& mesh) {
  Hash hash;
  hash.values(mesh.position).values(mesh.uv).values(mesh.weld).values(mesh.triangle);
  hash.number(mesh.welded).number(mesh.periodic_uv).bytes(&mesh.length_per_uv, sizeof mesh.length_per_uv);
  return hash.hex();
}

Mesh finish(const Surface& surface, const std::string& name, glm::dvec3 rotation) {
  const std::vector<glm::dvec3> point = normalised(surface, rotation);
  std::vector<Surface::Corners> uv = surface.uv;
  if (!surface.periodic_uv && !(surface.keep_uv && fits(uv))) fit_uv(uv);

  const std::vector<std::uint32_t> point_order = morton_order(point);
  std::vector<std::uint32_t> rank(point.size());
  for (std::uint32_t i = 0; i < point_order.size(); ++i) rank[point_order[i]] = i;

  std::vector<glm::dvec3> centroid;
  centroid.reserve(surface.triangle.size());
  for (const auto& [a, b, c] : surface.triangle) centroid.push_back((point[a] + point[b] + point[c]) / 3.0);

  Mesh mesh;
  mesh.name = name;
  mesh.periodic_uv = surface.periodic_uv;
  mesh.notes = surface.notes;
  mesh.welded = std::uint32_t(point.size());
  mesh.length_per_uv = length_per_uv(point, surface, uv);

  // A copy is a surface point with a UV; copies are numbered by point, then UV.
  std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> copies;
  const auto key = [&](std::uint32_t f, std::size_t k) {
    const glm::vec2 at(uv[f][k]);
    return std::tuple(rank[surface.triangle[f][k]], at.x, at.y);
  };
  for (std::uint32_t f = 0; f < surface.triangle.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) copies[key(f, k)] = 0;
  for (auto& [copy, number] : copies) {
    const auto& [welded, u, v] = copy;
    number = std::uint32_t(mesh.position.size());
    mesh.position.emplace_back(point[point_order[welded]]);
    mesh.uv.emplace_back(u, v);
    mesh.weld.push_back(welded);
  }
  for (const std::uint32_t f : morton_order(centroid))
    mesh.triangle.emplace_back(copies.at(key(f, 0)), copies.at(key(f, 1)), copies.at(key(f, 2)));
  mesh.hash = content_hash(mesh);
  return mesh;
}

}  // namespace pelage
