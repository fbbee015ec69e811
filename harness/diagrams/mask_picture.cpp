#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "harness/diagrams/diagrams.hpp"

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

/// Returns for each pixel of a square picture whether a triangle of the UV map contains its centre.
std::vector<bool> inside_of(const Mesh& mesh, int side) {
  std::vector<bool> inside(std::size_t(side) * std::size_t(side));
  for (const glm::uvec3& t : mesh.triangle) {
    const glm::dvec2 a = in_picture(mesh.uv[t.x], side), b = in_picture(mesh.uv[t.y], side),
                     c = in_picture(mesh.uv[t.z], side);
    const auto cross = [](const glm::dvec2& u, const glm::dvec2& v) { return u.x * v.y - u.y * v.x; };
    const glm::dvec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
    const auto pixel = [&](double x) { return std::clamp(int(std::floor(x)), 0, side - 1); };
    for (int y = pixel(low.y); y <= pixel(high.y); ++y)
      for (int x = pixel(low.x); x <= pixel(high.x); ++x) {
        const glm::dvec2 p(x + 0.5, y + 0.5);
        const double u = cross(b - a, p - a), v = cross(c - b, p - b), w = cross(a - c, p - c);
        if ((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))
          inside[std::size_t(y) * std::size_t(side) + std::size_t(x)] = true;
      }
  }
  return inside;
}

const glm::vec3 outside_colour(0.22f);

Picture empty_picture(int width, int height) {
  return {width, height,
          std::vector<glm::vec4>(std::size_t(width) * std::size_t(height), glm::vec4(0, 0, 0, 1))};
}

/// Fills `width` columns of the picture from the column `x` on.
void fill(Picture& picture, int x, int width, const glm::vec4& colour) {
  for (int y = 0; y < picture.height; ++y)
    for (int i = 0; i < width; ++i) picture.at(x + i, y) = colour;
}

}  // namespace

glm::vec3 clump_colour(const glm::vec4& clump) {
  if (!(clump.w > 0)) return glm::vec3(0);
  const std::uint32_t mixed = (std::bit_cast<std::uint32_t>(clump.x) * 0x9e3779b1u) ^
                              (std::bit_cast<std::uint32_t>(clump.y) * 0x85ebca6bu);
  const float share = float((mixed * 0xc2b2ae35u) >> 16) / 65535.0f;
  return clump.w * glm::mix(glm::vec3(0.05f, 0.15f, 1.0f), glm::vec3(0.15f, 0.6f, 1.0f), share);
}

Picture mask_picture(const FrameInput& input, const std::vector<glm::vec4>& mask, int side) {
  Picture picture = empty_picture(side, side);
  const std::vector<bool> inside = inside_of(*input.mesh, side);
  const int size = input.scene.wetness.size;
  const bool discs = input.scene.clump.cells == "consistent";  // a clump ends at its radius, not at a texel
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      if (!inside[std::size_t(y) * std::size_t(side) + std::size_t(x)]) {
        picture.at(x, y) = glm::vec4(outside_colour, 1);
        continue;
      }
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
  if (mean_length(mesh, edges.inner, side) >= least_edge) draw(edges.inner, {1, 1, 1, 0.4f}, 1.0);
  draw(edges.border, {1, 1, 1, 0.9f}, 1.5);
  return picture;
}

Picture coat_picture(const CoatTexture& coat) {
  Picture picture = empty_picture(coat.size, coat.size);
  for (int y = 0; y < coat.size; ++y)
    for (int x = 0; x < coat.size; ++x) {
      const auto& t = coat.texel[std::size_t(coat.size - 1 - y) * std::size_t(coat.size) + std::size_t(x)];
      picture.at(x, y) = glm::vec4(t[0], t[1], t[2], 255) / 255.0f;
    }
  return picture;
}

Picture slices_picture(const FurTexture& fur) {
  constexpr int shown = 4, gap = 8;  // number of slices; width of the line between them in pixels
  const int side = std::min(fur.size, 64), zoom = 256 / side, width = zoom * side;
  const auto grey = [&](int layer, int x, int y) {
    const auto row = std::size_t(layer) * std::size_t(fur.size) + std::size_t(y);
    const auto& t = fur.level[0][row * std::size_t(fur.size) + std::size_t(x)];
    return float(t[0]) / 255.0f * float(t[1]) / 127.5f;
  };
  Picture picture = empty_picture(shown * width + (shown - 1) * gap, width);
  float brightest = 0;
  for (int i = 0; i < shown; ++i) {
    const int layer = fur.layers * (2 * i + 1) / (2 * shown);
    for (int y = 0; y < width; ++y)
      for (int x = 0; x < width; ++x) {
        const float here = grey(layer, x / zoom, (width - 1 - y) / zoom);
        picture.at(i * (width + gap) + x, y) = glm::vec4(here, here, here, 1);
        brightest = std::max(brightest, here);
      }
  }
  for (glm::vec4& pixel : picture.pixel)
    if (brightest > 0) pixel = glm::vec4(glm::sqrt(glm::vec3(pixel) / brightest), 1);
  for (int i = 1; i < shown; ++i) fill(picture, i * (width + gap) - gap, gap, glm::vec4(0.5f, 0.5f, 0.5f, 1));
  return picture;
}

}  // namespace pelage::diagrams
