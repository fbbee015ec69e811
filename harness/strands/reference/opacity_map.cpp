
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/strands/reference/drawing.hpp"

namespace pelage::strands::reference {
namespace {

// The least 1 - A for the optical depth of a texel.
constexpr double least_through = 0x1p-20;

glm::dvec3 in_light(const LightView& view, glm::dvec3 point) {
  const glm::dvec4 p(point, 1);
  return {glm::dot(glm::dvec4(view.row_x), p), glm::dot(glm::dvec4(view.row_y), p),
          glm::dot(glm::dvec4(view.row_z), p)};
}

}  // namespace

LightColumns light_columns(const Look& look, const LightView& view, const std::vector<DrawnStrand>& strands) {
  const auto size = std::size_t(view.size);
  LightColumns columns(size * size);
  for (std::uint32_t i = 0; i < strands.size(); ++i) {
    const DrawnStrand& strand = strands[i];
    Curve curve;
    for (std::size_t k = 0; k < 3; ++k) curve.p[k] = in_light(view, glm::dvec3(strand.point[k]));
    std::vector<Vertex> vertices;
    for (int k = 0; k <= look.segments; ++k) {
      const double t = double(k) / look.segments;
      Vertex vertex;
      vertex.place = glm::dvec2(curve.at(t)) + 0.5 * double(view.size);
      vertex.half = 0.5 * double(strand.width) * (1 - double(look.taper) * t) / double(view.texel);
      vertex.alpha = alpha_of(look, strand, i, t);
      vertex.depth = curve.at(t).z;
      vertices.push_back(vertex);
    }
    each_fragment(vertices, view.size, view.size, [&](int x, int y, const Fragment& fragment) {
      columns[std::size_t(y) * size + std::size_t(x)].push_back({fragment.alpha, fragment.depth});
    });
  }
  return columns;
}

OpacityMap opacity_map(const LightColumns& columns) {
  OpacityMap map;
  for (const std::vector<LightFragment>& column : columns) {
    Texel texel;
    double alphas = 0;
    for (std::size_t i = 0; i < column.size(); ++i) {
      texel.first = i == 0 ? column[i].depth : std::min(texel.first, column[i].depth);
      texel.through *= 1 - column[i].alpha;
      alphas += column[i].alpha;
      texel.mean += column[i].alpha * column[i].depth;
    }
    texel.mean = alphas > 0 ? texel.mean / alphas : texel.first;
    map.push_back(texel);
  }
  return map;
}

OpacityMap opacity_map(const Look& look, const LightView& view, const std::vector<DrawnStrand>& strands) {
  return opacity_map(light_columns(look, view, strands));
}

double texel_light(const Look& look, const Texel& texel, double z) {
  const auto part = [&](double length) { return std::clamp((z - texel.first) / length, 0.0, 1.0); };
  const double length = double(look.shadow.length);
  if (look.shadow.reading == Shadow::linear) return 1 - (1 - texel.through) * part(length);
  const double optical_depth = -std::log(std::max(texel.through, least_through));
  return std::exp(-optical_depth * part(std::max(length, 2 * (texel.mean - texel.first))));
}

double key_light(const Look& look, const LightView& view, const OpacityMap& map, glm::dvec3 point) {
  const glm::dvec3 p = in_light(view, point);
  const double last = view.size - 1;
  const glm::dvec2 place = glm::clamp(glm::dvec2(p) + 0.5 * view.size - 0.5, 0.0, last);
  const glm::dvec2 corner = glm::min(glm::floor(place), last - 1), part = place - corner;
  const auto light = [&](int right, int down) {
    const auto x = std::size_t(corner.x) + std::size_t(right), y = std::size_t(corner.y) + std::size_t(down);
    return texel_light(look, map[y * std::size_t(view.size) + x], p.z);
  };
  const double above = light(0, 0) + part.x * (light(1, 0) - light(0, 0));
  const double below = light(0, 1) + part.x * (light(1, 1) - light(0, 1));
  return above + part.y * (below - above);
}

}  // namespace pelage::strands::reference
