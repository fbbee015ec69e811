// The sides of triangles, and groups of connected elements.
#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace pelage {

constexpr std::uint32_t no_index = 0xffffffffu;

/// The side of a triangle from its corner `corner` to the next one.
struct Side {
  std::uint32_t low, high;  ///< indices of the side's end points, low < high
  std::uint32_t face, corner;
  bool forward;  ///< true: `high` comes directly after `low` in the face's cyclic list of corners
};

/// Returns the sides of all triangles, sorted so that sides with the same end points are adjacent.
template <class Triangle>
std::vector<Side> sides_of(const std::vector<Triangle>& triangles) {
  std::vector<Side> sides(triangles.size() * 3);
  for (std::uint32_t f = 0; f < triangles.size(); ++f) {
    const std::uint32_t corner[] = {triangles[f][0], triangles[f][1], triangles[f][2]};
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = corner[k], b = corner[(k + 1) % 3];
      sides[3 * f + k] = {std::min(a, b), std::max(a, b), f, k, a < b};
    }
  }
  std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.low, s.high, s.face, s.corner); });
  return sides;
}

/// Returns the sides of all triangles as pairs of a corner and the next one, in ascending order.
template <class Triangle>
std::vector<std::pair<std::uint32_t, std::uint32_t>> directed_sides(const std::vector<Triangle>& triangles) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;
  sides.reserve(triangles.size() * 3);
  for (const Triangle& t : triangles) {
    sides.emplace_back(t[0], t[1]);
    sides.emplace_back(t[1], t[2]);
    sides.emplace_back(t[2], t[0]);
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// Divides elements, which have the numbers from 0 on, into groups. Each element is a group of its own until
/// join() is called.
class Groups {
 public:
  explicit Groups(std::size_t count) : root_(count) { std::iota(root_.begin(), root_.end(), 0u); }
  /// Returns the least element of the group of `i`.
  std::uint32_t find(std::uint32_t i) {
    while (root_[i] != i) i = root_[i] = root_[root_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    root_[std::max(a, b)] = std::min(a, b);
  }
  /// Returns the number of the group of each element. Groups are numbered from 0 in the order of their least
  /// elements.
  std::vector<std::uint32_t> numbers() {
    std::vector<std::uint32_t> number(root_.size());
    std::uint32_t next = 0;
    for (std::uint32_t i = 0; i < number.size(); ++i) number[i] = find(i) == i ? next++ : number[find(i)];
    return number;
  }

 private:
  std::vector<std::uint32_t> root_;
};

}  // namespace pelage
