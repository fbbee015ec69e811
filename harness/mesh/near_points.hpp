// Finds points by their position.
#pragma once
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

#include "harness/hash.hpp"

namespace pelage {

/// Points in cubic cells of one side.
class NearPoints {
 public:
  explicit NearPoints(double side) : side_(side) {}
  void add(glm::dvec3 p, std::uint32_t number) { numbers_[key(cell(p))].push_back(number); }
  /// Calls `visit` for the points in the cell of p and in its neighbours, at least for those that are nearer
  /// to p than one side.
  template <class Visit>
  void around(glm::dvec3 p, const Visit& visit) const {
    const glm::dvec3 own = cell(p);
    for (const int x : {-1, 0, 1})
      for (const int y : {-1, 0, 1})
        for (const int z : {-1, 0, 1})
          if (const auto found = numbers_.find(key(own + glm::dvec3(x, y, z))); found != numbers_.end())
            for (const std::uint32_t number : found->second) visit(number);
  }

 private:
  /// Adding 0 turns -0 to 0, whose bytes differ.
  glm::dvec3 cell(glm::dvec3 p) const { return glm::floor(p / side_) + 0.0; }
  static std::uint64_t key(glm::dvec3 cell) { return Hash().bytes(&cell, sizeof cell).value(); }
  double side_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> numbers_;
};

}  // namespace pelage
