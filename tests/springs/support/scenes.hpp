// The dynamics (forces, motion of the object, solver and time step), the topologies and solvers, and the
// meshes that the tests in tests/springs use.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"
#include "tests/support/device.hpp"
#include "tests/support/texts.hpp"

namespace pelage::springs::test {

using pelage::test::queue;

inline constexpr float fur_length = 0.05f;

/// Returns dynamics with all effects: gravity, gusts, and an object that travels, shakes, spins and swings.
inline Dynamics lively(Solver solver) {
  Dynamics d;
  d.solver = solver;
  d.step = solver == Solver::explicit_euler ? 1e-3f : 1.0f / 240;
  d.wind = {{1, 0.2f, 0.5f}, 3, 0.4f, 1, 0.7f};
  d.motion = {{0.3f, 0, 0.1f}, {0.02f, 0.05f, -0.01f}, 1.3f, {0.3f, 1, 0.2f}, 0.7f, 0.4f, 1.1f};
  return d;
}

/// Returns dynamics in gusts, with an object at rest: those of experiments/banisch2006-longest-step.toml with
/// the spring constant k = 10 N/m.
inline Dynamics windy(Solver solver) {
  Dynamics d;
  d.solver = solver;
  d.wind = {{1, 0.2f, 0.5f}, 3, 0.4f, 1, 1};
  return d;
}

/// Returns dynamics with only springs and the return force (Eq. 5 of Banisch and Wuethrich 2006): no gravity,
/// wind or drag, and an object at rest.
inline Dynamics still(Solver solver) {
  Dynamics d;
  d.solver = solver;
  d.gravity = {0, 0, 0};
  d.drag = 0;
  return d;
}

using Case = std::tuple<Kind, Solver>;

/// Returns one force in newtons per stick: `force` for the sticks at the corners of triangle `face`, else 0.
inline std::vector<glm::vec3> poke(const SpringNetwork& network, std::size_t face, glm::vec3 force) {
  std::vector<glm::vec3> push(network.sticks(), glm::vec3(0));
  for (int c = 0; c < 3; ++c) push[network.corner[face][c]] = force;
  return push;
}

/// Returns the largest distance between entries of equal index. If an entry is not finite, returns 1e9.
template <class A, class B>
double largest_difference(const std::vector<A>& a, const std::vector<B>& b) {
  EXPECT_EQ(a.size(), b.size());
  double worst = 0;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    const double d = glm::distance(glm::dvec3(a[i]), glm::dvec3(b[i]));
    worst = d < 1e9 ? std::max(worst, d) : 1e9;
  }
  return worst;
}

/// Returns a mesh with the given points and triangles and without UV seams.
inline Mesh mesh_of(std::vector<glm::vec3> points, std::vector<glm::uvec3> triangles) {
  Mesh mesh;
  mesh.name = "formula";
  mesh.welded = std::uint32_t(points.size());
  for (std::uint32_t i = 0; i < mesh.welded; ++i) {
    mesh.weld.push_back(i);
    mesh.uv.push_back({0.5f, 0.5f});
  }
  mesh.position = std::move(points);
  mesh.triangle = std::move(triangles);
  return mesh;
}

/// Returns the unit square in the plane y = 0, facing +y. It has `quads` x `quads` quads, each split into
/// four triangles at its centre.
inline Mesh square(int quads) {
  std::vector<glm::vec3> points;
  std::vector<glm::uvec3> triangles;
  const int side = quads + 1;
  const float step = 1.0f / float(quads);
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) points.push_back({float(i) * step, 0, float(j) * step});
  for (int j = 0; j < quads; ++j)
    for (int i = 0; i < quads; ++i) {
      const auto centre = std::uint32_t(points.size());
      points.push_back({(float(i) + 0.5f) * step, 0, (float(j) + 0.5f) * step});
      const auto a = std::uint32_t(j * side + i), b = a + 1, c = a + std::uint32_t(side), d = c + 1;
      triangles.insert(triangles.end(), {{a, centre, b}, {b, centre, d}, {d, centre, c}, {c, centre, a}});
    }
  return mesh_of(std::move(points), std::move(triangles));
}

/// Returns an icosphere of radius 1 with 20 * 4^halvings triangles.
inline Mesh sphere(int halvings) {
  const float g = (1 + std::sqrt(5.0f)) / 2;
  std::vector<glm::vec3> points{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<glm::uvec3> triangles{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int halving = 0; halving < halvings; ++halving) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    const auto between = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, fresh] =
          middle.try_emplace({std::min(a, b), std::max(a, b)}, std::uint32_t(points.size()));
      if (fresh) points.push_back(0.5f * (points[a] + points[b]));
      return entry->second;
    };
    std::vector<glm::uvec3> finer;
    for (const glm::uvec3& t : triangles) {
      const std::uint32_t a = between(t.x, t.y), b = between(t.y, t.z), c = between(t.z, t.x);
      finer.insert(finer.end(), {{t.x, a, c}, {a, t.y, b}, {c, b, t.z}, {a, b, c}});
    }
    triangles = std::move(finer);
  }
  for (glm::vec3& p : points) p = glm::normalize(p);
  return mesh_of(std::move(points), std::move(triangles));
}

/// Returns the mesh `whole` with a cut along the plane x = 0, like a UV seam: points with triangles on both
/// sides of the plane are duplicated.
inline Mesh cut_in_two(const Mesh& whole) {
  Mesh mesh = whole;
  mesh.position.clear(), mesh.weld.clear(), mesh.uv.clear();
  std::map<std::pair<std::uint32_t, bool>, std::uint32_t> copies;
  for (glm::uvec3& t : mesh.triangle) {
    const bool right = (whole.position[t.x] + whole.position[t.y] + whole.position[t.z]).x > 1e-4f;
    for (int c = 0; c < 3; ++c) {
      const auto [entry, fresh] = copies.try_emplace({t[c], right}, std::uint32_t(mesh.weld.size()));
      if (fresh) {
        mesh.position.push_back(whole.position[t[c]]);
        mesh.weld.push_back(t[c]);
        mesh.uv.push_back({right ? 0.75f : 0.25f, 0.5f});
      }
      t[c] = entry->second;
    }
  }
  return mesh;
}

/// Returns the number of edges of the mesh. The function collects vertex pairs in a set, so that it is
/// independent of springs::build(), whose springs the tests count.
inline std::size_t edge_count(const Mesh& mesh, bool welded) {
  std::set<std::set<std::uint32_t>> edges;
  for (const glm::uvec3& t : mesh.triangle)
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t a = t[c], b = t[(c + 1) % 3];
      edges.insert(welded ? std::set{mesh.weld[a], mesh.weld[b]} : std::set{a, b});
    }
  return edges.size();
}

}  // namespace pelage::springs::test
