#include "harness/diagrams/mask_picture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "harness/diagrams/lines.hpp"

namespace pelage::diagrams {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The edges of the UV map: those of one triangle only (borders and seams), and all others.
struct AtlasEdges {
  std::vector<Edge> border, inner;
};

AtlasEdges edges_of(const Mesh& mesh) {
  std::set<Edge> once;
  AtlasEdges edges;
  for (const glm::uvec3& t : mesh.triangle)
    for (int k = 0; k < 3; ++k) {
      const Edge edge{t[k], t[(k + 1) % 3]}, opposite{edge.second, edge.first};
      if (once.erase(opposite))
        edges.inner.push_back(edge);
      else
        once.insert(edge);
    }
  edges.border.assign(once.begin(), once.end());
  return edges;
}

/// Returns the position of a UV in the picture, in pixels from its upper left corner.
glm::dvec2 in_picture(const glm::vec2& uv, int side) {
  return glm::dvec2(double(uv.x), 1.0 - double(uv.y)) * double(side);
}

double mean_length(const Mesh& mesh, const std::vector<Edge>& edges, int side) {
  double sum = 0;
  for (const auto& [a, b] : edges)
    sum += glm::distance(in_picture(mesh.uv[a], side), in_picture(mesh.uv[b], side));
  return edges.empty() ? 0.0 : sum / double(edges.size());
}

}  // namespace

glm::vec3 clump_colour(const glm::vec4& clump) {
  if (!(clump.w > 0)) return glm::vec3(0);
  const std::uint32_t mixed = (std::bit_cast<std::uint32_t>(clump.x) * 0x9e3779b1u) ^
                              (std::bit_cast<std::uint32_t>(clump.y) * 0x85ebca6bu);
  const float share = float((mixed * 0xc2b2ae35u) >> 16) / 65535.0f;
  return clump.w * (0.6f + 0.4f * share) * glm::vec3(0.15f, 0.35f, 1.0f);
}

Picture mask_picture(const FrameInput& input, const std::vector<glm::vec4>& mask, int side) {
  Picture picture{side, side, std::vector<glm::vec4>(std::size_t(side) * std::size_t(side), {0, 0, 0, 1})};
  const int size = input.scene.wetness.size;
  const bool discs = input.scene.clump.cells == "consistent";  // a clump ends at its radius, not at a texel
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const glm::dvec2 uv((x + 0.5) / side, 1.0 - (y + 0.5) / side);
      const auto texel = [&](double u) { return std::size_t(std::clamp(int(u * size), 0, size - 1)); };
      const glm::vec4& clump = mask[texel(uv.y) * std::size_t(size) + texel(uv.x)];
      if (discs && glm::distance(uv, glm::dvec2(clump.x, clump.y)) > double(clump.z)) continue;
      picture.at(x, y) = glm::vec4(clump_colour(clump), 1);
    }
  const Mesh& mesh = *input.mesh;
  const AtlasEdges edges = edges_of(mesh);
  const auto draw = [&](const std::vector<Edge>& list, const glm::vec4& colour, double width) {
    for (const auto& [a, b] : list)
      draw_line(picture, in_picture(mesh.uv[a], side), in_picture(mesh.uv[b], side), width, colour);
  };
  if (mean_length(mesh, edges.inner, side) >= least_edge) draw(edges.inner, {0.6f, 0.6f, 0.6f, 0.35f}, 1.0);
  draw(edges.border, {1, 1, 1, 0.9f}, 1.5);
  return picture;
}

}  // namespace pelage::diagrams
