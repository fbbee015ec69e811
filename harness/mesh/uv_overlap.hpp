// Finds pairs of triangles that overlap in a UV map.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "harness/mesh/surface.hpp"

namespace pelage {

/// Returns twice the signed area of a triangle in UV. It is negative if the triangle is flipped (clockwise).
double twice_uv_area(const Surface::Corners& uv);

/// Returns the pairs (a, b), a < b, of triangles that overlap in UV, in ascending order. `uv` contains the
/// corners of each triangle. Two triangles overlap if no translation by less than 1e-9 separates them, so
/// triangles that only touch at an edge or a corner do not overlap.
std::vector<std::pair<std::uint32_t, std::uint32_t>> uv_overlaps(const std::vector<Surface::Corners>& uv);

}  // namespace pelage
