#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

#include "harness/prepare/coat.hpp"

namespace pelage {
namespace {

constexpr int nowhere = -1;
// Tolerance of barycentric coordinates, so that a texel centre on an edge counts as inside both triangles.
constexpr double edge_slack = 1e-9;

struct Grid {
  int size;
  bool periodic;
  std::vector<glm::vec3> point;
  /// For each texel, the index of the covered texel from which its surface point is copied.
  std::vector<int> source;
};

void draw(Grid& grid, const glm::dvec2 (&uv)[3], const glm::dvec3 (&position)[3]) {
  const glm::dvec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
  const double det = a.x * b.y - a.y * b.x;
  if (std::abs(det) < 1e-24) return;
  const int last = grid.size - 1;
  auto low = [&](double x) { return std::clamp(int(std::ceil(x - 0.5)), 0, last); };
  auto high = [&](double x) { return std::clamp(int(std::floor(x - 0.5)), 0, last); };
  const auto [u0, u1] = std::minmax({uv[0].x, uv[1].x, uv[2].x});
  const auto [v0, v1] = std::minmax({uv[0].y, uv[1].y, uv[2].y});
  for (int j = low(v0); j <= high(v1); ++j)
    for (int i = low(u0); i <= high(u1); ++i) {
      const glm::dvec2 p = glm::dvec2(i + 0.5, j + 0.5) - uv[0];
      const double s = (p.x * b.y - p.y * b.x) / det, t = (a.x * p.y - a.y * p.x) / det;
      if (s < -edge_slack || t < -edge_slack || s + t > 1 + edge_slack) continue;
      const int texel = j * grid.size + i;
      grid.point[std::size_t(texel)] =
          glm::vec3((1 - s - t) * position[0] + s * position[1] + t * position[2]);
      grid.source[std::size_t(texel)] = texel;
    }
}

double square_distance(const Grid& grid, int from, int to) {
  int dx = std::abs(from % grid.size - to % grid.size), dy = std::abs(from / grid.size - to / grid.size);
  if (grid.periodic) {
    dx = std::min(dx, grid.size - dx);
    dy = std::min(dy, grid.size - dy);
  }
  return double(dx) * dx + double(dy) * dy;
}

/// Finds, for every texel, the nearest texel that a UV triangle covers, by jump flooding (Rong and Tan 2006).
void fill_gutters(Grid& grid) {
  int step = 1;
  while (2 * step < grid.size) step *= 2;
  for (; step > 0; step /= 2) {
    const std::vector<int> before = grid.source;
    for (int j = 0; j < grid.size; ++j)
      for (int i = 0; i < grid.size; ++i) {
        const int here = j * grid.size + i;
        int best = before[std::size_t(here)];
        for (int k = 0; k < 9; ++k) {
          int x = i + (k % 3 - 1) * step, y = j + (k / 3 - 1) * step;
          if (grid.periodic) {
            x = (x + grid.size) % grid.size;
            y = (y + grid.size) % grid.size;
          }
          if (x < 0 || y < 0 || x >= grid.size || y >= grid.size) continue;
          const int other = before[std::size_t(y) * std::size_t(grid.size) + std::size_t(x)];
          if (other == nowhere) continue;
          if (best == nowhere || square_distance(grid, here, other) < square_distance(grid, here, best))
            best = other;
        }
        grid.source[std::size_t(here)] = best;
      }
  }
}

}  // namespace

std::vector<glm::vec3> surface_map(const Mesh& mesh, int size) {
  const std::size_t texels = std::size_t(size) * std::size_t(size);
  Grid grid{size, mesh.periodic_uv, std::vector<glm::vec3>(texels, glm::vec3(0)),
            std::vector<int>(texels, nowhere)};
  for (const glm::uvec3& f : mesh.triangle) {
    glm::dvec2 uv[3];
    glm::dvec3 position[3];
    for (int c = 0; c < 3; ++c) {
      uv[c] = glm::dvec2(mesh.uv[f[c]]) * double(size);
      position[c] = glm::dvec3(mesh.position[f[c]]);
    }
    draw(grid, uv, position);
  }
  fill_gutters(grid);
  std::vector<glm::vec3> out(texels);
  for (std::size_t t = 0; t < texels; ++t)
    out[t] = grid.source[t] == nowhere ? glm::vec3(0) : grid.point[std::size_t(grid.source[t])];
  return out;
}

}  // namespace pelage
