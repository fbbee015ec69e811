#include "harness/mesh/uv_pieces.hpp"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <queue>

#include "harness/mesh/sides.hpp"

namespace pelage {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Reasons for which triangles are cut out. Triangles of different reasons are in different pieces.
enum : char { stays, overlaps, shrunk, enlarged };

glm::dvec3 centroid(const Surface& surface, std::uint32_t f) {
  const auto& [a, b, c] = surface.triangle[f];
  return (surface.point[a] + surface.point[b] + surface.point[c]) / 3.0;
}

/// Marks triangles, so that the unmarked ones do not overlap. Triangles that overlap get different colours.
/// Neighbours get the same colour where this is possible, so that each sheet of the map has one colour. Of
/// triangles that are connected by overlaps, and by neighbours that overlap others, those of the colour with
/// the largest area stay unmarked.
void mark_overlaps(const Pairs& pairs, const Neighbours& next, const std::vector<double>& area,
                   std::vector<char>& mark) {
  std::vector<Faces> list(mark.size());  // for each unmarked triangle, the unmarked ones that overlap it
  for (const auto& [a, b] : pairs)
    if (!mark[a] && !mark[b]) list[a].push_back(b), list[b].push_back(a);
  std::vector<std::uint32_t> colour(mark.size(), no_index);
  const auto has = [&](std::uint32_t f) { return colour[f] != no_index; };
  const auto choose = [&](std::uint32_t f) {
    const auto taken = [&](std::uint32_t c) {
      return std::ranges::any_of(list[f], [&](std::uint32_t g) { return colour[g] == c; });
    };
    for (const std::uint32_t g : next[f])
      if (g != no_face && has(g) && !taken(colour[g])) return colour[g];
    std::uint32_t own = 0;
    while (taken(own)) ++own;
    return own;
  };
  for (const auto& [seed, other] : pairs) {  // ascending, so each group begins with its first triangle
    if (list[seed].empty() || has(seed)) continue;
    std::vector<std::uint32_t> group;
    std::map<std::uint32_t, double> sum;  // area of each colour
    std::deque<std::uint32_t> near{seed}, far;
    while (!near.empty() || !far.empty()) {
      std::deque<std::uint32_t>& queue = near.empty() ? far : near;
      const std::uint32_t f = queue.front();
      queue.pop_front();
      if (has(f)) continue;
      colour[f] = choose(f);
      sum[colour[f]] += area[f];
      group.push_back(f);
      for (const std::uint32_t g : next[f])
        if (g != no_face && !list[g].empty() && !has(g)) near.push_back(g);
      for (const std::uint32_t g : list[f])
        if (!has(g)) far.push_back(g);
    }
    const auto best = std::ranges::max_element(sum, {}, [](const auto& entry) { return entry.second; });
    for (const std::uint32_t f : group) mark[f] = colour[f] != best->first ? overlaps : stays;
  }
}

/// Appends the connected groups of the triangles with mark[f] == which.
void add_groups(const Neighbours& next, const std::vector<char>& mark, char which, std::vector<Faces>& all) {
  Groups groups(mark.size());
  for (std::uint32_t f = 0; f < mark.size(); ++f)
    for (const std::uint32_t g : next[f])
      if (mark[f] == which && g != no_face && mark[g] == which) groups.join(f, g);
  std::map<std::uint32_t, Faces> parts;  // in the order of their first triangles
  for (std::uint32_t f = 0; f < mark.size(); ++f)
    if (mark[f] == which) parts[groups.find(f)].push_back(f);
  for (auto& [first, part] : parts) all.push_back(std::move(part));
}

double sum_of(const std::vector<double>& area, const Faces& faces) {
  return std::accumulate(faces.begin(), faces.end(), 0.0,
                         [&](double sum, std::uint32_t f) { return sum + area[f]; });
}

/// Marks the triangles that the map stretches. Connected parts of less than the area `least` stay unmarked.
void mark_stretch(const Surface& surface, const Neighbours& next, const std::vector<double>& area,
                  double most, double least, std::vector<char>& mark) {
  std::vector<char> stretch(mark.size());
  const double total = std::accumulate(area.begin(), area.end(), 0.0);
  double uv_total = 0;  // twice the area of the map
  for (const Surface::Corners& corners : surface.uv) uv_total += std::abs(twice_uv_area(corners));
  std::ranges::transform(surface.uv, area, stretch.begin(),
                         [&](const Surface::Corners& corners, double own) -> char {
                           const double ratio = std::abs(twice_uv_area(corners)) * total / (own * uv_total);
                           return ratio * most < 1 ? shrunk : ratio > most ? enlarged : stays;
                         });
  for (const char reason : {shrunk, enlarged}) {
    std::vector<Faces> parts;
    add_groups(next, stretch, reason, parts);
    for (const Faces& part : parts)
      if (sum_of(area, part) >= least)
        for (const std::uint32_t f : part) mark[f] = reason;
  }
}

/// Gives the mark of the nearest marked triangle to the triangles whose centroid is at most `growth` away
/// from it, along paths over the centroids of neighbours.
void grow(const Surface& surface, const Neighbours& next, double growth, std::vector<char>& mark) {
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<double> distance(mark.size(), std::numeric_limits<double>::max());
  for (std::uint32_t f = 0; f < mark.size(); ++f)
    if (mark[f]) queue.push({distance[f] = 0, f});
  while (!queue.empty()) {
    const auto [d, f] = queue.top();
    queue.pop();
    if (d > distance[f]) continue;
    for (const std::uint32_t g : next[f]) {
      if (g == no_face) continue;
      const double there = d + glm::distance(centroid(surface, f), centroid(surface, g));
      if (there <= growth && there < distance[g]) mark[g] = mark[f], queue.push({distance[g] = there, g});
    }
  }
}

/// Gives the mark of an adjacent piece to the triangles of `part`, if there is a piece with another mark.
void join(const Neighbours& next, const Faces& part, std::vector<char>& mark) {
  const char own = mark[part.front()];
  char adjacent = own;
  for (const std::uint32_t f : part)
    for (const std::uint32_t g : next[f])
      if (g != no_face && adjacent == own && mark[g] != stays) adjacent = mark[g];
  for (const std::uint32_t f : part) mark[f] = adjacent;
}

constexpr double least_depth = 1e-9;

/// Returns true if a line along an edge of `a` separates the triangles, except for a depth below least_depth.
bool edge_separates(const Surface::Corners& a, const Surface::Corners& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 along = a[(k + 1) % 3] - a[k];
    const double length = glm::length(along);
    if (!(length > 0)) return true;
    const glm::dvec2 across = glm::dvec2(-along.y, along.x) / length;
    const auto height = [&](const glm::dvec2& p) { return glm::dot(across, p - a[k]); };
    const double own = height(a[(k + 2) % 3]);
    const auto [low, high] = std::minmax({height(b[0]), height(b[1]), height(b[2])});
    if (std::min(high, std::max(own, 0.0)) - std::max(low, std::min(own, 0.0)) < least_depth) return true;
  }
  return false;
}

constexpr int side = 1024;         // cells per side of the square
constexpr int texel = side / 256;  // cells per texel of a wetness mask of 256 x 256 texels
constexpr int margin = 2 * texel;  // from the border of the square
constexpr int gap = 4 * texel;     // between charts
constexpr std::size_t corners = side + 1;

int cell_of(double x) {
  return std::clamp(int(std::floor(x * side)), 0, side - 1);
}

}  // namespace

Neighbours neighbours_of(const Surface& surface, bool in_uv) {
  const std::vector<Side> sides = sides_of(surface.triangle);
  const auto uv_at = [&](const Side& s, std::uint32_t p) {
    return surface.uv[s.face][surface.triangle[s.face][s.corner] == p ? s.corner : (s.corner + 1) % 3];
  };
  Neighbours next(surface.triangle.size(), {no_face, no_face, no_face});
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &x = sides[i], &y = sides[i + 1];
    if (x.low != y.low || x.high != y.high) continue;
    if (in_uv && (uv_at(x, x.low) != uv_at(y, x.low) || uv_at(x, x.high) != uv_at(y, x.high))) continue;
    next[x.face][x.corner] = y.face, next[y.face][y.corner] = x.face;
  }
  return next;
}

Pieces choose_pieces(const Surface& surface, const PieceRules& rules) {
  std::vector<double> area;
  for (std::uint32_t f = 0; f < surface.triangle.size(); ++f) area.push_back(surface_area(surface, f));
  std::vector<char> mark;
  for (const Surface::Corners& corners : surface.uv)
    mark.push_back(twice_uv_area(corners) < 0 ? overlaps : stays);
  const Neighbours next = neighbours_of(surface, true);
  const double small = 4 * std::numbers::pi * rules.growth * rules.growth;
  if (rules.most_stretch > 0) mark_stretch(surface, next, area, rules.most_stretch, small / 4, mark);
  mark_overlaps(uv_overlaps(surface.uv), next, area, mark);
  if (std::ranges::all_of(mark, [](char m) { return m == stays; })) return {};
  grow(surface, next, rules.growth, mark);
  for (const char reason : {stays, overlaps, shrunk, enlarged}) {
    std::vector<Faces> parts;
    add_groups(next, mark, reason, parts);
    for (const Faces& part : parts)
      if (sum_of(area, part) < small) join(next, part, mark);
  }
  Pieces pieces;
  add_groups(next, mark, stays, pieces.rest);
  for (const char reason : {overlaps, shrunk, enlarged}) add_groups(next, mark, reason, pieces.piece);
  return pieces;
}

double surface_area(const Surface& surface, std::uint32_t f) {
  const auto& [a, b, c] = surface.triangle[f];
  return 0.5 *
         glm::length(glm::cross(surface.point[b] - surface.point[a], surface.point[c] - surface.point[a]));
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> uv_overlaps(const std::vector<Surface::Corners>& uv) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, std::uint32_t>;
  std::vector<Box> boxes;
  boxes.reserve(uv.size());
  for (std::uint32_t f = 0; f < uv.size(); ++f) {
    const auto [left, right] = std::ranges::minmax(uv[f], {}, &glm::dvec2::x);
    const auto [low, high] = std::ranges::minmax(uv[f], {}, &glm::dvec2::y);
    double from[] = {left.x, low.y}, to[] = {right.x, high.y};
    boxes.emplace_back(from, to, f);
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& x, const Box& y) {
    const std::uint32_t a = std::min(x.info(), y.info()), b = std::max(x.info(), y.info());
    if (!edge_separates(uv[a], uv[b]) && !edge_separates(uv[b], uv[a])) pairs.emplace_back(a, b);
  });
  std::ranges::sort(pairs);
  return pairs;
}

FreeSpace::FreeSpace() : taken_(std::size_t(side) * side) {}

void FreeSpace::take(const Surface::Corners& uv) {
  const auto [left, right] = std::ranges::minmax(uv, {}, &glm::dvec2::x);
  const auto [low, high] = std::ranges::minmax(uv, {}, &glm::dvec2::y);
  for (int y = cell_of(low.y); y <= cell_of(high.y); ++y)
    for (int x = cell_of(left.x); x <= cell_of(right.x); ++x)
      taken_[std::size_t(y) * side + std::size_t(x)] = 1;
}

std::optional<glm::dvec2> FreeSpace::place(glm::dvec2 size) {
  // The number of taken cells below and to the left of each corner of a cell.
  std::vector<int> sum(corners * corners);
  for (std::size_t y = 0; y < side; ++y)
    for (std::size_t x = 0; x < side; ++x)
      sum[(y + 1) * corners + x + 1] =
          taken_[y * side + x] + sum[y * corners + x + 1] + sum[(y + 1) * corners + x] - sum[y * corners + x];
  const auto below = [&](int x, int y) {
    return sum[std::size_t(std::clamp(y, 0, side)) * corners + std::size_t(std::clamp(x, 0, side))];
  };
  const auto is_free = [&](int left, int low, int right, int high) {
    return below(right, high) - below(left, high) - below(right, low) + below(left, low) == 0;
  };
  const int width = int(std::ceil(size.x * side)), height = int(std::ceil(size.y * side));
  for (int y = margin; y + height <= side - margin; y += texel)
    for (int x = margin; x + width <= side - margin; x += texel)
      if (is_free(x - gap, y - gap, x + width + gap, y + height + gap)) {
        for (int j = y; j < y + height; ++j)
          std::fill_n(taken_.begin() + std::ptrdiff_t(j) * side + x, width, char(1));
        return glm::dvec2(x, y) / double(side);
      }
  return {};
}

}  // namespace pelage
