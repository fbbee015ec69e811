
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

}  // namespace pelage::strands::reference
