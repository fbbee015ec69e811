#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "harness/strands/reference/drawing.hpp"

namespace pelage::strands::reference {
namespace {

using Vec = glm::dvec3;

// Depth behind the skin, in R, at which a strand becomes invisible.
constexpr double fade = 1.0 / 128;

/// A vertex in view coordinates, with the skin's colour there.
struct Corner {
  Vec view{0}, colour{0};
};

/// Rows or columns of pixels, from `first` to `last`.
struct Range {
  int first, last;
};

Range range_of(const std::array<Corner, 3>& c, int axis, int pixels, double near) {
  double low = INFINITY, high = -INFINITY;
  for (const Corner& corner : c) {
    if (corner.view.z < near) return {0, pixels - 1};
    const double place = corner.view[axis] / corner.view.z + 0.5 * pixels;
    low = std::min(low, place);
    high = std::max(high, place);
  }
  return {int(std::clamp(std::floor(low) - 1, 0.0, double(pixels))),
          int(std::clamp(std::ceil(high) + 1, -1.0, double(pixels - 1)))};
}

}  // namespace

std::vector<Vec> skin_colours(const Look& look, const SkinSurface& skin, const ShadowMap* shadow) {
  std::vector<Vec> colours;
  for (std::size_t v = 0; v < skin.position.size(); ++v) {
    const Vec normal(skin.normal[v]);
    double key = double(look.intensity) * std::max(0.0, glm::dot(normal, glm::normalize(Vec(look.light))));
    if (shadow) key *= key_light(look, shadow->view, shadow->map, Vec(skin.position[v]));
    const Vec light = double(look.ambient) + key + fill_light(look, normal);
    colours.push_back((1 - double(look.skin_shadow)) * Vec(skin.colour[v]) * light);
  }
  return colours;
}

std::vector<SkinPixel> skin_pixels(const Camera& camera, const Look& look, const SkinSurface& skin,
                                   const ShadowMap* shadow) {
  const std::vector<Vec> colours = skin_colours(look, skin, shadow);
  std::vector<Corner> corners;
  for (std::size_t v = 0; v < skin.position.size(); ++v) {
    const glm::dvec4 p(Vec(skin.position[v]), 1);
    corners.push_back({{glm::dot(glm::dvec4(camera.row_x), p), glm::dot(glm::dvec4(camera.row_y), p),
                        glm::dot(glm::dvec4(camera.row_w), p)},
                       colours[v]});
  }
  std::vector<SkinPixel> pixels(std::size_t(camera.width) * std::size_t(camera.height));
  for (const glm::uvec3& t : skin.triangle) {
    const std::array<Corner, 3> c{corners[t.x], corners[t.y], corners[t.z]};
    // The pixel (x, y) shows the point w0 c0 + w1 c1 + w2 c2 of the triangle if its view coordinates are
    // (x W, y W, W). With the weights divided by W, this is a system of linear equations.
    const glm::dmat3 views(c[0].view, c[1].view, c[2].view);
    if (glm::determinant(views) == 0) continue;
    const glm::dmat3 inverse = glm::inverse(views);
    const Range rows = range_of(c, 1, camera.height, double(camera.near));
    const Range columns = range_of(c, 0, camera.width, double(camera.near));
    for (int y = rows.first; y <= rows.last; ++y)
      for (int x = columns.first; x <= columns.last; ++x) {
        const Vec weight = inverse * Vec(x + 0.5 - 0.5 * camera.width, y + 0.5 - 0.5 * camera.height, 1);
        if (weight.x < 0 || weight.y < 0 || weight.z < 0) continue;
        const double depth = 1 / (weight.x + weight.y + weight.z);
        SkinPixel& pixel = pixels[std::size_t(y) * std::size_t(camera.width) + std::size_t(x)];
        if (depth < double(camera.near) || depth >= pixel.depth) continue;
        pixel.depth = depth;
        pixel.colour = depth * (weight.x * c[0].colour + weight.y * c[1].colour + weight.z * c[2].colour);
      }
  }
  return pixels;
}

double before_skin(const SkinPixel& pixel, double z) {
  return std::clamp((pixel.depth - z) / fade + 1, 0.0, 1.0);
}

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
  Look fixed = look;
  fixed.own_segments = false;  // which depends on the camera
  for (std::uint32_t i = 0; i < strands.size(); ++i) {
    const DrawnStrand& strand = strands[i];
    Curve curve;
    for (std::size_t k = 0; k < 3; ++k) curve.p[k] = in_light(view, glm::dvec3(strand.point[k]));
    std::vector<Vertex> vertices;
    const int segments = least_segments(fixed, strand);
    for (int k = 0; k <= segments; ++k) {
      const double t = double(k) / segments;
      Vertex vertex;
      vertex.place = glm::dvec2(curve.at(t)) + 0.5 * double(view.size);
      vertex.half = half_width(look, strand, t) / double(view.texel);
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
