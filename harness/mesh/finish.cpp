#include "harness/mesh/finish.hpp"

#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <tuple>

#include "harness/hash.hpp"

namespace pelage {
namespace {

// Quantizes a coordinate in [-1,1] to 21 bits and inserts two zero bits between neighbouring bits.
std::uint64_t spread(double coordinate) {
  std::uint64_t bits = std::uint64_t(std::clamp((coordinate * 0.5 + 0.5) * 2097151.0, 0.0, 2097151.0));
  bits = (bits | bits << 32) & 0x1f00000000ffffu;
  bits = (bits | bits << 16) & 0x1f0000ff0000ffu;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
  return (bits | bits << 2) & 0x1249249249249249u;
}

// Returns the permutation that sorts `points` along the Morton curve; points with equal keys keep their
// order.
std::vector<std::uint32_t> morton_order(const std::vector<glm::dvec3>& points) {
  std::vector<std::uint64_t> key(points.size());
  std::transform(points.begin(), points.end(), key.begin(),
                 [](glm::dvec3 p) { return spread(p.x) | spread(p.y) << 1 | spread(p.z) << 2; });
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return key[i]; });
  return order;
}

// Returns the order of triangles along the Morton curve, by their centroids.
std::vector<std::uint32_t> morton_order(const std::vector<Surface::Triangle>& triangles,
                                        const std::vector<glm::dvec3>& point) {
  std::vector<glm::dvec3> centroid;
  centroid.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) centroid.push_back((point[a] + point[b] + point[c]) / 3.0);
  return morton_order(centroid);
}

// Returns the position of each index in a permutation.
std::vector<std::uint32_t> inverse(const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> position(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) position[order[i]] = i;
  return position;
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

Box box_of(const std::vector<Surface::Corners>& uv, double degrees) {
  Box box;
  const UvTurn turn(degrees);
  for (const auto& corners : uv) {
    for (const glm::dvec2& p : corners) {
      const glm::dvec2 q = turn(p);
      box.low = glm::min(box.low, q), box.high = glm::max(box.high, q);
    }
  }
  return box;
}

// Rotates and scales a UV map into the unit square. The rotation maximizes the size of the map. The map keeps
// a margin from each side of the square: 2/256 of the side's length (two texels of a wetness mask of 256 x
// 256 texels).
void fit_uv(std::vector<Surface::Corners>& uv) {
  double best = 0;
  Box box = box_of(uv, best);
  for (double degrees = 2; degrees < 90; degrees += 2)
    if (const Box other = box_of(uv, degrees); other.side() < box.side() * (1 - 1e-6))
      box = other, best = degrees;
  constexpr double margin = 2.0 / 256;
  const double scale = (1 - 2 * margin) / box.side();
  const glm::dvec2 shift = glm::dvec2(0.5) - scale * 0.5 * (box.low + box.high);
  const UvTurn turn(best);
  for (auto& corners : uv)
    for (glm::dvec2& p : corners) p = turn(p) * scale + shift;
}

// Returns true if the map lies in the unit square. In this case, finish() does not change a UV map from a
// mesh file, so that textures made for this map still match.
bool fits(const std::vector<Surface::Corners>& uv) {
  const Box box = box_of(uv, 0);
  return box.low.x >= 0 && box.low.y >= 0 && box.high.x <= 1 && box.high.y <= 1;
}

// Returns the mean length on the surface per unit of u and per unit of v. For a periodic map, each of the two
// values is a mean over the triangles, weighted by UV area. For other maps, both values are
// sqrt(surface area / UV area).
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

bool needs_fit(const Surface& surface) {
  const bool given = surface.keep_uv || surface.packed_uv;
  return !surface.periodic_uv && !(given && fits(surface.uv));
}

}  // namespace

void fit_uv(Surface& surface) {
  if (needs_fit(surface)) fit_uv(surface.uv);
}

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

Mesh turned(Mesh mesh, glm::dvec3 rotation) {
  if (rotation == glm::dvec3(0)) return mesh;
  const glm::dmat3 matrix = rotation_matrix(rotation);
  std::vector<glm::dvec3> point(mesh.welded);
  for (std::size_t i = 0; i < mesh.position.size(); ++i)
    point[mesh.weld[i]] = matrix * glm::dvec3(mesh.position[i]);

  const std::vector<std::uint32_t> rank = inverse(morton_order(point));
  std::vector<std::uint32_t> copy_order(mesh.position.size());
  std::iota(copy_order.begin(), copy_order.end(), 0u);
  // This sort orders the vertices by the rank of their surface points. It is stable: the vertices at one
  // surface point are already sorted by UV, and they keep this order.
  std::ranges::stable_sort(copy_order, {}, [&](std::uint32_t i) { return rank[mesh.weld[i]]; });
  const std::vector<std::uint32_t> number = inverse(copy_order);
  std::vector<Surface::Triangle> welded;
  for (const glm::uvec3& t : mesh.triangle)
    welded.push_back({mesh.weld[t.x], mesh.weld[t.y], mesh.weld[t.z]});

  Mesh result = mesh;
  for (std::uint32_t i = 0; i < copy_order.size(); ++i) {
    const std::uint32_t from = copy_order[i];
    result.position[i] = glm::vec3(point[mesh.weld[from]]);
    result.uv[i] = mesh.uv[from];
    result.weld[i] = rank[mesh.weld[from]];
  }
  result.triangle.clear();
  for (const std::uint32_t f : morton_order(welded, point)) {
    const glm::uvec3& t = mesh.triangle[f];
    result.triangle.emplace_back(number[t.x], number[t.y], number[t.z]);
  }
  result.notes.push_back(
      fmt::format("turned by {}, {} and {} degrees about x, y and z", rotation.x, rotation.y, rotation.z));
  result.hash = content_hash(result);
  return result;
}

Mesh finish(const Surface& surface, const std::string& name, glm::dvec3 rotation) {
  const std::vector<glm::dvec3> point = normalised(surface, rotation);
  std::vector<Surface::Corners> uv = surface.uv;
  const bool fitted = needs_fit(surface);
  if (fitted) fit_uv(uv);

  const std::vector<std::uint32_t> point_order = morton_order(point);
  const std::vector<std::uint32_t> rank = inverse(point_order);

  Mesh mesh;
  mesh.name = name;
  mesh.periodic_uv = surface.periodic_uv;
  mesh.notes = surface.notes;
  if (fitted && surface.keep_uv)
    mesh.notes.push_back(
        "the file's UV map leaves the unit square: it was rotated and scaled into the square, so textures that were made for this map do not fit any more");
  mesh.welded = std::uint32_t(point.size());
  mesh.length_per_uv = length_per_uv(point, surface, uv);

  // The mesh has one vertex for each distinct pair of a surface point and a UV. The vertices are sorted by
  // surface point, then by UV. The next lines group the corners of the triangles by surface point.
  const auto point_of = [&](std::uint32_t c) { return rank[surface.triangle[c / 3][c % 3]]; };
  const auto uv_of = [&](std::uint32_t c) { return glm::vec2(uv[c / 3][c % 3]); };
  const auto corners = std::uint32_t(3 * surface.triangle.size());
  std::vector<std::uint32_t> row(point.size() + 1, 0), corner(corners), copy(corners);
  for (std::uint32_t c = 0; c < corners; ++c) ++row[point_of(c) + 1];
  std::partial_sum(row.begin(), row.end(), row.begin());
  {
    std::vector<std::uint32_t> next(row.begin(), row.end() - 1);
    for (std::uint32_t c = 0; c < corners; ++c) corner[next[point_of(c)]++] = c;
  }
  for (std::uint32_t p = 0; p < point.size(); ++p) {
    std::ranges::sort(corner.begin() + row[p], corner.begin() + row[p + 1], {}, [&](std::uint32_t c) {
      const glm::vec2 at = uv_of(c);
      return std::tuple(at.x, at.y, c);
    });
    for (std::uint32_t i = row[p]; i < row[p + 1]; ++i) {
      const glm::vec2 at = uv_of(corner[i]);
      if (i == row[p] || at != uv_of(corner[i - 1])) {
        mesh.position.emplace_back(point[point_order[p]]);
        mesh.uv.push_back(at);
        mesh.weld.push_back(p);
      }
      copy[corner[i]] = std::uint32_t(mesh.position.size() - 1);
    }
  }
  mesh.triangle.reserve(surface.triangle.size());
  for (const std::size_t f : morton_order(surface.triangle, point))
    mesh.triangle.emplace_back(copy[3 * f], copy[3 * f + 1], copy[3 * f + 2]);
  mesh.hash = content_hash(mesh);
  return mesh;
}

Sphere bounding_sphere(const std::vector<glm::dvec3>& points) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Traits = CGAL::Min_sphere_of_points_d_traits_3<Kernel, double>;
  std::vector<Kernel::Point_3> list;
  list.reserve(points.size());
  for (const glm::dvec3& p : points) list.emplace_back(p.x, p.y, p.z);
  CGAL::Min_sphere_of_spheres_d<Traits> sphere(list.begin(), list.end());
  const auto* centre = sphere.center_cartesian_begin();
  return {{centre[0], centre[1], centre[2]}, sphere.radius()};
}

}  // namespace pelage
