#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "harness/error.hpp"
#include "harness/mesh/laplace.hpp"
#include "harness/mesh/sides.hpp"
#include "harness/mesh/unfold.hpp"
#include "harness/mesh/uv_pieces.hpp"

namespace pelage {
namespace {

using Columns = LaplaceSolver::Columns;

// A triangle in its own plane with the corners (0, 0), (base, 0) and (x, y). weight[k] is half the cotangent
// of the angle opposite to side k, which goes from corner k to k + 1.
struct Local {
  double base, x, y;
  glm::dvec3 weight;
  glm::dvec2 corner(int k) const {
    return k == 0 ? glm::dvec2(0) : k == 1 ? glm::dvec2(base, 0) : glm::dvec2(x, y);
  }
};

// Returns half the cotangent of the angle between a and b. The cotangent is clamped to [0.01, 100], so that
// the linear systems stay positive definite for obtuse and degenerate triangles.
double half_cotangent(glm::dvec3 a, glm::dvec3 b) {
  const double sine = glm::length(glm::cross(a, b));
  return 0.5 * std::clamp(sine > 0 ? glm::dot(a, b) / sine : 1.0, 0.01, 100.0);
}

std::vector<Local> locals(const Surface& surface, const Disk& disk) {
  std::vector<Local> list;
  list.reserve(disk.triangle.size());
  for (const auto& [i, j, k] : disk.triangle) {
    const glm::dvec3 a = surface.point[disk.point[i]], b = surface.point[disk.point[j]],
                     c = surface.point[disk.point[k]];
    const double base = glm::distance(a, b);
    const double x = base > 0 ? glm::dot(c - a, b - a) / base : 0;
    const double y = std::sqrt(std::max(0.0, glm::dot(c - a, c - a) - x * x));
    const glm::dvec3 weight(half_cotangent(a - c, b - c), half_cotangent(b - a, c - a),
                            half_cotangent(c - b, a - b));
    list.push_back({base, x, y, weight});
  }
  return list;
}

// Returns the vertices on the border of a disk (the surface, cut open), in order along the border. Returns an
// empty vector if the border is not a single loop.
std::vector<std::uint32_t> border_of(const Disk& disk) {
  const auto sides = directed_sides(disk.triangle);
  std::vector<std::uint32_t> next(disk.point.size(), no_index), border;
  std::size_t count = 0;
  std::uint32_t first = no_index;
  for (const auto& [p, q] : sides) {
    if (std::binary_search(sides.begin(), sides.end(), std::pair(q, p))) continue;
    if (next[p] != no_index) return {};
    next[p] = q, first = std::min(first, p), ++count;
  }
  // Each vertex loses its successor when the walk leaves it, so the walk ends when it is back at `first`.
  for (std::uint32_t p = first; p != no_index; p = std::exchange(next[p], no_index)) border.push_back(p);
  if (border.size() != count + 1) return {};
  border.pop_back();
  return border;
}

// Places the border vertices by arc length on a circle whose area equals the surface area of the disk. Writes
// only the rows of x that belong to border vertices.
void place_border(const Surface& surface, const Disk& disk, const std::vector<std::uint32_t>& border,
                  const std::vector<Local>& local, Columns& x) {
  double area = 0, length = 0, at = 0;
  for (const Local& t : local) area += 0.5 * t.base * t.y;
  const auto side = [&](std::size_t i) {
    return glm::distance(surface.point[disk.point[border[i]]],
                         surface.point[disk.point[border[(i + 1) % border.size()]]]);
  };
  for (std::size_t i = 0; i < border.size(); ++i) length += side(i);
  const double radius = std::sqrt(area / std::numbers::pi);
  for (std::size_t i = 0; i < border.size(); ++i) {
    const double angle = 2 * std::numbers::pi * at / length;
    x(border[i], 0) = radius * std::cos(angle), x(border[i], 1) = radius * std::sin(angle);
    at += side(i);
  }
}

// Returns the matrix that subtracts from each unknown vertex, times the sum of its weights, its weighted
// neighbours. `number` is the row of each unknown vertex, and no_index for a known vertex. For each side from
// an unknown to a known vertex, the function calls known(row, vertex, weight).
template <class Known>
LaplaceSolver::Matrix laplacian(const Disk& disk, const std::vector<Local>& local,
                                const std::vector<std::uint32_t>& number, std::uint32_t unknowns,
                                const Known& known) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(disk.triangle.size() * 6 + unknowns);
  std::vector<double> diagonal(unknowns, 0);
  for (std::size_t f = 0; f < local.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t p = disk.triangle[f][std::size_t(k)],
                          q = disk.triangle[f][std::size_t((k + 1) % 3)];
      const double w = local[f].weight[k];
      for (const auto& [from, to] : {std::pair(p, q), std::pair(q, p)}) {
        if (number[from] == no_index) continue;
        diagonal[number[from]] += w;
        if (number[to] == no_index)
          known(number[from], to, w);
        else
          entries.emplace_back(int(number[from]), int(number[to]), -w);
      }
    }
  }
  for (std::uint32_t i = 0; i < unknowns; ++i) entries.emplace_back(int(i), int(i), diagonal[i]);
  LaplaceSolver::Matrix matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// Computes the harmonic map: every inner vertex is the weighted mean of its neighbours. The map is
// one-to-one, because the weights are positive and the border is convex (Tutte 1963). Returns false if the
// solver fails.
bool harmonic(const Disk& disk, const std::vector<Local>& local, const std::vector<std::uint32_t>& border,
              Columns& x) {
  std::vector<std::uint32_t> number(disk.point.size());
  for (const std::uint32_t p : border) number[p] = no_index;
  std::uint32_t unknowns = 0;
  for (std::uint32_t& n : number)
    if (n != no_index) n = unknowns++;
  if (unknowns == 0) return true;
  Columns b = Columns::Zero(unknowns, x.cols()), inner = b;
  const LaplaceSolver solver(
      laplacian(disk, local, number, unknowns,
                [&](std::uint32_t row, std::uint32_t vertex, double w) { b.row(row) += w * x.row(vertex); }));
  const bool solved = solver.solve(b, inner).has_value();
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] != no_index) x.row(Eigen::Index(v)) = inner.row(number[v]);
  return solved;
}

glm::dvec2 at(const Columns& x, Eigen::Index p) {
  return {x(p, 0), x(p, 1)};
}

LaplaceSolver::Matrix rigid_matrix(const Disk& disk, const std::vector<Local>& local) {
  std::vector<std::uint32_t> all(disk.point.size());
  std::iota(all.begin(), all.end(), 0u);
  LaplaceSolver::Matrix matrix =
      laplacian(disk, local, all, std::uint32_t(all.size()), [](std::uint32_t, std::uint32_t, double) {});
  // The equations leave the translation of the map free. Doubling the first diagonal element fixes the
  // translation, because the first vertex of the map then lies at the origin. The doubling does not change
  // the shape of the map.
  matrix.coeffRef(0, 0) *= 2;
  return matrix;
}

// Returns the right-hand side of the linear system in the global step of Liu et al. 2008. For each triangle,
// the function computes the rotation in the plane that best aligns the triangle's shape on the surface with
// its image in the current map x. The right-hand side sums the rotated sides of all triangles, weighted by
// Local::weight.
Columns turned_triangles(const Disk& disk, const std::vector<Local>& local, const Columns& x) {
  Columns b = Columns::Zero(x.rows(), x.cols());
  for (std::size_t f = 0; f < local.size(); ++f) {
    const auto& t = disk.triangle[f];
    const Local& l = local[f];
    double along = 0, across = 0;
    for (int k = 0; k < 3; ++k) {
      const int n = (k + 1) % 3;
      const glm::dvec2 d = at(x, t[std::size_t(k)]) - at(x, t[std::size_t(n)]), e = l.corner(k) - l.corner(n);
      along += l.weight[k] * (d.x * e.x + d.y * e.y);
      across += l.weight[k] * (d.x * e.y - d.y * e.x);
    }
    const double size = std::hypot(along, across);
    const auto [c, s] = size > 0 ? std::pair(along / size, across / size) : std::pair(1.0, 0.0);
    for (int k = 0; k < 3; ++k) {
      const int n = (k + 1) % 3;
      const glm::dvec2 e = l.corner(k) - l.corner(n);
      const double u = l.weight[k] * (c * e.x + s * e.y), v = l.weight[k] * (-s * e.x + c * e.y);
      b(t[std::size_t(k)], 0) += u, b(t[std::size_t(k)], 1) += v;
      b(t[std::size_t(n)], 0) -= u, b(t[std::size_t(n)], 1) -= v;
    }
  }
  return b;
}

// Moves each corner of a flipped face to the mean of its neighbours, unless the corner lies on the border.
// Stops when the number of flipped faces no longer decreases.
void unturn(const Disk& disk, const std::vector<std::uint32_t>& border, Columns& x) {
  std::vector<char> fixed(disk.point.size(), false);
  for (const std::uint32_t p : border) fixed[p] = true;
  std::size_t before = std::numeric_limits<std::size_t>::max();
  Columns kept = x;
  for (int round = 0; round < 20; ++round) {
    std::vector<char> move(disk.point.size(), false);
    std::size_t turned = 0;
    for (const auto& t : disk.triangle)
      if (!(twice_uv_area({at(x, t[0]), at(x, t[1]), at(x, t[2])}) > 0))
        ++turned, move[t[0]] = move[t[1]] = move[t[2]] = true;
    if (turned >= before) x = kept;
    if (turned == 0 || turned >= before) break;
    before = turned, kept = x;
    Columns sum = Columns::Zero(x.rows(), x.cols());
    std::vector<double> count(disk.point.size(), 0);
    for (const auto& t : disk.triangle)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t p = t[std::size_t(k)];
        if (!move[p] || fixed[p]) continue;
        sum.row(p) += x.row(t[std::size_t((k + 1) % 3)]) + x.row(t[std::size_t((k + 2) % 3)]);
        count[p] += 2;
      }
    for (std::size_t p = 0; p < count.size(); ++p)
      if (count[p] > 0) x.row(Eigen::Index(p)) = sum.row(Eigen::Index(p)) / count[p];
  }
}

[[noreturn]] void fail(const std::string& name) {
  throw InputError(fmt::format("{}: no UV map can be made for this mesh", name));
}

}  // namespace

FlatDisk flatten(const Surface& surface, const Disk& disk, const std::string& name,
                 const std::function<void(double)>& part, int iterations) {
  const auto tell = [&](int step) {
    if (part) part(double(step) / (iterations + 2));
  };
  tell(0);
  const std::vector<std::uint32_t> border = border_of(disk);
  if (border.empty()) fail(name);
  const std::vector<Local> local = locals(surface, disk);
  Columns circle = Columns::Zero(Eigen::Index(disk.point.size()), Columns::ColsAtCompileTime);
  place_border(surface, disk, border, local, circle);
  if (!harmonic(disk, local, border, circle)) fail(name);
  tell(1);
  FlatDisk flat;
  Columns x = circle;
  flat.rigid = iterations > 0;
  const LaplaceSolver solver(rigid_matrix(disk, local));
  for (int i = 0; i < iterations && flat.rigid; ++i) {
    tell(2 + i);
    flat.rigid = solver.solve(turned_triangles(disk, local, x), x).has_value();
  }
  if (flat.rigid) unturn(disk, border, x);
  MapQuality quality;
  const auto keep = [&](const Columns& map) {
    flat.uv.resize(disk.point.size());
    for (std::size_t i = 0; i < flat.uv.size(); ++i) flat.uv[i] = at(map, Eigen::Index(i));
    quality = map_quality(flat.uv, disk.triangle);
    return quality.usable;
  };
  flat.rigid = flat.rigid && keep(x);
  if (!flat.rigid && !keep(circle)) fail(name);
  flat.flipped = quality.flipped;
  return flat;
}

void need_cut(const Surface& surface, const Disk& disk, const std::string& name) {
  if (disk.point.size() > surface.point.size()) return;
  const auto sides = directed_sides(disk.triangle);
  const bool closed = std::ranges::all_of(sides, [&](const auto& side) {
    return std::binary_search(sides.begin(), sides.end(), std::pair(side.second, side.first));
  });
  if (closed)
    throw InputError(fmt::format("{}: the closed surface is not cut and cannot be flattened", name));
}

Surface with_map(const Surface& surface, const CutPlan& plan, const Disk& disk,
                 const std::vector<glm::dvec2>& uv, const std::string& method, std::size_t flipped) {
  Surface result = surface;
  result.notes.push_back(fmt::format(
      "UV map: one chart, {} vertices added at seams, {} cuts to tips of limbs, method: {}, {} faces flipped",
      disk.point.size() - surface.point.size(), plan.tips.size(), method, flipped));
  result.uv.clear();
  result.uv.reserve(disk.triangle.size());
  for (const auto& [a, b, c] : disk.triangle) result.uv.push_back({uv[a], uv[b], uv[c]});
  return result;
}

Surface unfold_file(const Surface& surface, const CutPlan& plan, const std::string& name,
                    const std::function<void(double)>& part) {
  const Disk disk = cut_open(surface, plan);
  need_cut(surface, disk, name);
  const FlatDisk flat = flatten(surface, disk, name, part);
  return with_map(surface, plan, disk, flat.uv,
                  flat.rigid ? "as rigidly as possible" : "harmonic on a circle", flat.flipped);
}

}  // namespace pelage
