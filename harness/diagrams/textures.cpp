#include "harness/diagrams/textures.hpp"

#include <algorithm>
#include <glm/exponential.hpp>

namespace pelage::diagrams {
namespace {

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
