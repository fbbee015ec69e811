#include "harness/mesh/quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "harness/mesh/sides.hpp"
#include "harness/parallel.hpp"

namespace pelage {
namespace {

template <class Visit>
void for_each_edge(const std::vector<Side>& sides, Visit visit) {
  for (std::size_t first = 0, last; first < sides.size(); first = last) {
    for (last = first + 1;
         last < sides.size() && sides[last].low == sides[first].low && sides[last].high == sides[first].high;)
      ++last;
    visit(first, last);
  }
}

double twice_map_area(const Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec2 a(mesh.uv[t.x]), b(mesh.uv[t.y]), c(mesh.uv[t.z]);
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Returns the number of faces that cover each texel centre. A centre on an edge belongs to only one of the
// two faces at this edge.
std::vector<std::uint8_t> cover(const Mesh& mesh, int side) {
  std::vector<std::uint8_t> count(std::size_t(side) * std::size_t(side), 0);
  constexpr int rows = 256;  // that a thread takes at a time
  for_each_index(std::size_t((side + rows - 1) / rows), [&](std::size_t band) {
    const int begin = int(band) * rows, end = std::min(side, begin + rows);
    for (const glm::uvec3& t : mesh.triangle) {
      glm::dvec2 p[3];
      for (int k = 0; k < 3; ++k) p[k] = glm::dvec2(mesh.uv[t[k]]) * double(side) - 0.5;
      const double low = std::min({p[0].y, p[1].y, p[2].y}), high = std::max({p[0].y, p[1].y, p[2].y});
      const int last = std::min(end, int(std::ceil(high)));
      for (int y = std::max(begin, int(std::ceil(low))); y < last; ++y) {
        double left = HUGE_VAL, right = -HUGE_VAL;
        for (int k = 0; k < 3; ++k) {
          // The intersection of edge and texel row is computed from the edge's lower end, so that both faces
          // at the edge get the same value.
          glm::dvec2 a = p[k], b = p[(k + 1) % 3];
          if (std::tie(a.y, a.x) > std::tie(b.y, b.x)) std::swap(a, b);
          if (!(a.y <= y && y < b.y)) continue;
          const double x = a.x + (y - a.y) * (b.x - a.x) / (b.y - a.y);
          left = std::min(left, x), right = std::max(right, x);
        }
        for (int x = std::max(0, int(std::ceil(left))); x < side && x < right; ++x) {
          auto& texel = count[std::size_t(y) * std::size_t(side) + std::size_t(x)];
          if (texel < 255) ++texel;
        }
      }
    }
  });
  return count;
}

struct Covered {
  // once: number of texels covered by at least one face; more: number of texels covered by at least two
  std::size_t once = 0, more = 0;
};

Covered covered_by(const Mesh& mesh, int side) {
  Covered covered;
  for (const std::uint8_t count : cover(mesh, side)) covered.once += count > 0, covered.more += count > 1;
  return covered;
}

}  // namespace

Topology topology(const Mesh& mesh) {
  Topology topology{};
  topology.copies = mesh.position.size();
  topology.points = mesh.welded;
  topology.faces = mesh.triangle.size();
  std::vector<glm::uvec3> triangles;
  for (const glm::uvec3& t : mesh.triangle)
    triangles.emplace_back(mesh.weld[t.x], mesh.weld[t.y], mesh.weld[t.z]);

  Groups pieces(topology.faces), rims(topology.points), fans(topology.faces * 3);
  std::vector<char> on_border(topology.points, false);
  const auto corner = [&](std::uint32_t f, std::uint32_t p) {
    return 3 * f + (triangles[f].x == p ? 0u : triangles[f].y == p ? 1u : 2u);
  };
  const std::vector<Side> sides = sides_of(triangles);
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    ++topology.edges;
    const Side& a = sides[first];
    if (last - first == 1) {
      ++topology.boundary_edges;
      rims.join(a.low, a.high);
      on_border[a.low] = on_border[a.high] = true;
    } else if (last - first > 2 || a.forward == sides[first + 1].forward) {
      ++topology.bad_edges;
    }
    for (std::size_t i = first + 1; i < last; ++i) {
      pieces.join(a.face, sides[i].face);
      for (const std::uint32_t p : {a.low, a.high}) fans.join(corner(a.face, p), corner(sides[i].face, p));
    }
  });
  for (std::uint32_t f = 0; f < topology.faces; ++f) topology.components += pieces.find(f) == f;
  std::vector<std::uint32_t> fan(topology.points, 0);
  for (std::uint32_t c = 0; c < topology.faces * 3; ++c)
    if (fans.find(c) == c) ++fan[triangles[c / 3][int(c % 3)]];
  for (std::uint32_t p = 0; p < topology.points; ++p) {
    topology.bad_points += fan[p] != 1;
    topology.borders += on_border[p] && rims.find(p) == p;
  }
  const long euler = long(topology.points) - long(topology.edges) + long(topology.faces);
  topology.genus = (2 * long(topology.components) - long(topology.borders) - euler) / 2;
  return topology;
}

std::vector<std::uint32_t> charts(const Mesh& mesh) {
  Groups groups(mesh.triangle.size());
  const std::vector<Side> sides = sides_of(mesh.triangle);
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first + 1; i < last; ++i) groups.join(sides[first].face, sides[i].face);
  });
  return groups.numbers();
}

std::vector<std::string> uv_warnings(const Mesh& mesh) {
  std::vector<std::string> warnings;
  double area = 0, turned = 0;
  std::size_t faces = 0;
  for (const glm::uvec3& t : mesh.triangle) {
    const double twice = twice_map_area(mesh, t);
    area += std::abs(twice);
    if (twice < 0) turned -= twice, ++faces;
  }
  if (faces > 0)
    warnings.push_back(fmt::format(
        "UV map: {} {} flipped (clockwise in UV; {:.4f}% of the area of the map); textures appear mirrored on flipped faces",
        faces, faces == 1 ? "face is" : "faces are", 100 * turned / area));
  const Covered covered = covered_by(mesh, 2048);
  if (double(covered.more) >= std::max(1.0, 1e-4 * double(covered.once)))
    warnings.push_back(fmt::format(
        "UV map: {:.2f}% of the map overlaps itself; where it overlaps, two points of the surface read the same texel",
        100 * double(covered.more) / double(covered.once)));
  return warnings;
}

std::vector<std::string> mesh_warnings(const Mesh& mesh) {
  std::vector<std::string> warnings = mesh.from_file ? mesh.notes : std::vector<std::string>();
  for (std::string& warning : uv_warnings(mesh)) warnings.push_back(std::move(warning));
  return warnings;
}

UvQuality uv_quality(const Mesh& mesh, int side) {
  UvQuality quality{};
  double uv_area = 0, flipped = 0, surface_area = 0;  // all doubled
  // For each face, the ratio of its UV area to its surface area, followed by its surface area.
  std::vector<std::pair<double, double>> ratio;
  for (const glm::uvec3& t : mesh.triangle) {
    const glm::dvec3 a(mesh.position[t.x]), b(mesh.position[t.y]), c(mesh.position[t.z]);
    const double twice = twice_map_area(mesh, t), surface = glm::length(glm::cross(b - a, c - a));
    uv_area += std::abs(twice);
    if (twice < 0) flipped -= twice, ++quality.flipped_faces;
    surface_area += surface;
    if (surface > 0) ratio.emplace_back(std::abs(twice) / surface, surface);
  }
  quality.flipped = uv_area > 0 ? flipped / uv_area : 0;
  std::sort(ratio.begin(), ratio.end());
  const auto percentile = [&](double part) {
    double sum = 0;
    for (const auto& [value, weight] : ratio)
      if ((sum += weight) >= part * surface_area) return value * surface_area / uv_area;
    return 0.0;
  };
  quality.area_low = percentile(0.01), quality.area_median = percentile(0.5),
  quality.area_high = percentile(0.99);
  quality.area_5 = percentile(0.05), quality.area_95 = percentile(0.95);

  const Covered covered = covered_by(mesh, side);
  quality.covered = double(covered.once) / (double(side) * side);
  quality.overlapping = covered.once > 0 ? double(covered.more) / double(covered.once) : 0;
  const std::vector<std::uint32_t> chart = charts(mesh);
  quality.charts = chart.empty() ? 0 : *std::max_element(chart.begin(), chart.end()) + 1;
  return quality;
}

}  // namespace pelage
