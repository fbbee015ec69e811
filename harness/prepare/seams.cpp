#include <algorithm>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <utility>

#include "harness/prepare/droplets.hpp"

namespace pelage {
namespace {

using Complex = std::complex<double>;

Complex complex_of(glm::vec2 uv) {
  return {double(uv.x), double(uv.y)};
}

/// An edge on a UV seam, as seen from one of its sides.
struct SeamEdge {
  Complex from, along;        ///< UV of the first end, and from the first to the second end, on this side
  Complex other_from, scale;  ///< on the other side: UV of the first end, and the factor of the similarity
  glm::dvec3 start, end;      ///< positions of the ends, R

  Complex across(Complex uv) const { return other_from + scale * (uv - from); }
  /// Length on the surface per unit of UV along the edge, on this side, R.
  double length_per_uv() const { return glm::distance(start, end) / std::abs(along); }
  /// Returns the parameter, 0 to 1, of the point of the edge that is nearest to `uv`.
  double nearest(Complex uv) const {
    return std::clamp((std::conj(along) * (uv - from)).real() / std::norm(along), 0.0, 1.0);
  }
};

constexpr double most_scale = 8;  // an edge whose lengths on its sides differ by a greater factor is left out

/// Returns the edges whose two triangles have different UVs at them, once for each side.
std::vector<SeamEdge> seam_edges(const Mesh& mesh) {
  using Ends = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<std::pair<Ends, Ends>> sides;  // an edge between surface points, and its vertices on one side
  sides.reserve(3 * mesh.triangle.size());
  for (const glm::uvec3& t : mesh.triangle)
    for (int c = 0; c < 3; ++c) {
      std::uint32_t a = t[c], b = t[(c + 1) % 3];
      if (mesh.weld[a] > mesh.weld[b]) std::swap(a, b);
      sides.push_back({{mesh.weld[a], mesh.weld[b]}, {a, b}});
    }
  std::stable_sort(sides.begin(), sides.end(), [](auto& a, auto& b) { return a.first < b.first; });
  std::vector<SeamEdge> edges;
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].first == sides[first].first) ++last;
    if (last - first != 2) continue;
    const Ends both[] = {sides[first].second, sides[first + 1].second};
    if (mesh.uv[both[0].first] == mesh.uv[both[1].first] &&
        mesh.uv[both[0].second] == mesh.uv[both[1].second])
      continue;
    for (int side = 0; side < 2; ++side) {
      const Ends &own = both[side], &other = both[1 - side];
      SeamEdge e;
      e.from = complex_of(mesh.uv[own.first]);
      e.along = complex_of(mesh.uv[own.second]) - e.from;
      e.other_from = complex_of(mesh.uv[other.first]);
      const Complex along = complex_of(mesh.uv[other.second]) - e.other_from;
      if (!(std::abs(e.along) > 0)) continue;
      e.scale = along / e.along;
      if (!(std::abs(e.scale) < most_scale && std::abs(e.scale) > 1 / most_scale)) continue;
      e.start = glm::dvec3(mesh.position[own.first]);
      e.end = glm::dvec3(mesh.position[own.second]);
      edges.push_back(e);
    }
  }
  return edges;
}

bool alike(const Droplet& a, const Droplet& b) {
  constexpr float share = 0.1f;  // of the smaller radius
  return glm::distance(a.centre, b.centre) < share * std::min(a.radius, b.radius) &&
         std::abs(a.radius - b.radius) < share * b.radius;
}

}  // namespace

std::vector<Droplet> across_seams(const Mesh& mesh, const std::vector<Droplet>& droplets) {
  constexpr std::size_t most = 96;  // most repetitions of a droplet
  // A repetition wets no point that is further from the droplet's surface point than its radius on the
  // surface, with this slack for the stretch of the UV map. Many repetitions along a curved seam thus cover
  // no more than one disc.
  constexpr double slack = 1.2;
  const std::vector<SeamEdge> edges = seam_edges(mesh);
  std::vector<Droplet> all;
  for (const Droplet& droplet : droplets) {
    std::vector<Droplet> own{droplet};
    for (std::size_t i = 0; i < own.size() && own.size() <= most; ++i) {
      const Complex centre = complex_of(own[i].centre);
      const double radius = double(own[i].radius);
      for (const SeamEdge& e : edges) {
        const double t = e.nearest(centre);
        if (std::abs(e.from + t * e.along - centre) > radius) continue;
        if (glm::distance(glm::mix(e.start, e.end, t), glm::dvec3(droplet.point)) > double(droplet.reach))
          continue;
        Droplet ghost = droplet;
        const Complex there = e.across(centre);
        ghost.centre = {float(there.real()), float(there.imag())};
        ghost.radius = float(radius * std::abs(e.scale));
        // The radius on the surface: beside this edge, or as it is on the mean of the map (Droplet::reach).
        const double on_surface = std::max(radius * e.length_per_uv(), 0.5 * double(droplet.reach));
        ghost.reach = float(std::min(double(droplet.reach), slack * on_surface));
        if (std::none_of(own.begin(), own.end(), [&](const Droplet& d) { return alike(d, ghost); }))
          own.push_back(ghost);
      }
    }
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

}  // namespace pelage
