// Small closed meshes for tests of the body of strands.
#pragma once
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

#include "harness/mesh/mesh.hpp"

namespace pelage::strands {

/// Returns a closed tube around the y axis. The tube has `rows` rings of `columns` points each, and one point
/// at each end. The function ring(t) returns the radius and the height y of the ring at the parameter t, 0
/// to 1.
template <class Ring>
std::shared_ptr<Mesh> tube(int rows, int columns, const Ring& ring) {
  auto mesh = std::make_shared<Mesh>();
  mesh->name = "tube";
  const auto add = [&](double radius, double height, double angle) {
    mesh->position.emplace_back(radius * std::cos(angle), height, radius * std::sin(angle));
  };
  add(0, ring(0.0).y, 0);
  for (int r = 1; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const glm::dvec2 at = ring(double(r) / rows);
      add(at.x, at.y, 2 * std::numbers::pi * c / columns);
    }
  add(0, ring(1.0).y, 0);
  const auto last = std::uint32_t(mesh->position.size() - 1);
  const auto point = [&](int r, int c) {
    return r == 0 ? 0 : r == rows ? last : std::uint32_t(1 + (r - 1) * columns + c % columns);
  };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const std::uint32_t a = point(r, c), b = point(r, c + 1), d = point(r + 1, c), e = point(r + 1, c + 1);
      if (r > 0) mesh->triangle.emplace_back(a, d, b);
      if (r + 1 < rows) mesh->triangle.emplace_back(b, d, e);
    }
  mesh->uv.assign(mesh->position.size(), glm::vec2(0));
  mesh->welded = last + 1;
  for (std::uint32_t i = 0; i <= last; ++i) mesh->weld.push_back(i);
  return mesh;
}

/// All surface points, for SkinMotion.
inline std::vector<std::uint32_t> points_of(const Mesh& mesh) {
  std::vector<std::uint32_t> points(mesh.welded);
  std::iota(points.begin(), points.end(), 0u);
  return points;
}

/// The unit sphere.
inline std::shared_ptr<Mesh> sphere_mesh(int rows = 48) {
  return tube(rows, 2 * rows, [](double t) {
    return glm::dvec2(std::sin(std::numbers::pi * t), -std::cos(std::numbers::pi * t));
  });
}

/// A cylinder with round ends: radius 0.4, height from -0.9 to 0.9.
inline std::shared_ptr<Mesh> cylinder_mesh(int rows = 24, int columns = 24) {
  return tube(rows, columns, [](double t) {
    const double y = 1.8 * t - 0.9;
    return glm::dvec2(0.4 * std::sqrt(std::max(0.0, std::min(1.0, 8 * (0.9 - std::abs(y))))), y);
  });
}

}  // namespace pelage::strands
