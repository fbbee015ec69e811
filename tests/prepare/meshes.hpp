// Small meshes of known geometry. R is the radius of a mesh, which is the unit of length.
#pragma once
#include <cstdint>
#include <memory>

#include "harness/mesh/mesh.hpp"

namespace pelage::test {

/// two_charts() is a square in the plane y = 0 with the normal +y. Each side of the square has chart_cells
/// cells. half_side is half the length of a side, in units of R.
inline constexpr int chart_cells = 20;
inline constexpr float half_side = 0.7f;
inline constexpr float chart_scale = 0.35f;  ///< UV units per R

/// Returns a square with a UV seam at x = 0. In the UV map the right half of the square is rotated by 90
/// degrees relative to the left half.
inline std::shared_ptr<const Mesh> two_charts() {
  auto mesh = std::make_shared<Mesh>();
  mesh->name = "two-charts";
  mesh->length_per_uv = glm::vec2(1.0f / chart_scale);
  constexpr int n = chart_cells, columns = n / 2 + 1, rows = n + 1;
  auto x = [](int i) { return half_side * float(2 * i - n) / n; };
  for (int side = 0; side < 2; ++side)
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) {
        const int column = i + side * n / 2;
        const glm::vec3 p(x(column), 0.0f, x(j));
        mesh->position.push_back(p);
        // X(u, v) is the surface point at (u, v). In the left half, u increases with x, and v increases with
        // -z, so the cross product of dX/du and dX/dv points along +y. In the right half, the directions of u
        // and v are rotated by 90 degrees.
        const glm::vec2 left(0.05f + chart_scale * (p.x + half_side),
                             0.05f + chart_scale * (half_side - p.z));
        const glm::vec2 right(0.45f + chart_scale * (p.z + half_side), 0.65f + chart_scale * p.x);
        mesh->uv.push_back(side == 0 ? left : right);
        mesh->weld.push_back(std::uint32_t(j * rows + column));
      }
  auto index = [](int side, int i, int j) { return std::uint32_t((side * rows + j) * columns + i); };
  for (int side = 0; side < 2; ++side)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n / 2; ++i) {
        const std::uint32_t a = index(side, i, j), b = index(side, i + 1, j), c = index(side, i + 1, j + 1),
                            d = index(side, i, j + 1);
        mesh->triangle.push_back({a, c, b});
        mesh->triangle.push_back({a, d, c});
      }
  mesh->welded = std::uint32_t(rows * rows);
  return mesh;
}

}  // namespace pelage::test
