#include "harness/shells/reference/textures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pelage::reference {
namespace {

/// Returns i modulo side. i is a whole number.
std::size_t wrapped_index(double i, int side) {
  const double inside = i - double(side) * std::floor(i / double(side));
  return std::min(std::size_t(inside >= 0.0 ? inside : 0.0), std::size_t(side - 1));
}

/// Interpolates texel(row, column) bilinearly at uv.
template <class Texel>
auto bilinear(int side, const glm::dvec2& uv, const Texel& texel) {
  const double x = uv.x * double(side) - 0.5, y = uv.y * double(side) - 0.5;
  const double i = std::floor(x), j = std::floor(y), s = x - i, t = y - j;
  const std::size_t i0 = wrapped_index(i, side), i1 = wrapped_index(i + 1.0, side);
  const std::size_t j0 = wrapped_index(j, side), j1 = wrapped_index(j + 1.0, side);
  return (1.0 - t) * ((1.0 - s) * texel(j0, i0) + s * texel(j0, i1)) +
         t * ((1.0 - s) * texel(j1, i0) + s * texel(j1, i1));
}

glm::dvec2 fur_level(const FurTexture& fur, const glm::dvec2& uv, int layer, std::size_t level) {
  const int side = fur.size >> level;
  const std::size_t row = std::size_t(side), slice = std::size_t(layer) * row * row;
  return bilinear(side, uv, [&](std::size_t j, std::size_t i) {
    const auto& bytes = fur.level[level][slice + j * row + i];
    return glm::dvec2(double(bytes[0]), double(bytes[1]));
  });
}

}  // namespace

FurSample sample_fur(const FurTexture& fur, const glm::dvec2& uv, int layer, double level, double power) {
  const double last = double(fur.level.size()) - 1.0;
  const double clamped = std::clamp(level, 0.0, last), lower = std::floor(clamped);
  const glm::dvec2 near = fur_level(fur, uv, layer, std::size_t(lower));
  const glm::dvec2 far = fur_level(fur, uv, layer, std::size_t(std::min(lower + 1.0, last)));
  const glm::dvec2 bytes = near + (clamped - lower) * (far - near);
  const double coverage = bytes.x / 255.0;
  return {power == 1.0 ? coverage : 1.0 - std::pow(1.0 - coverage, power), bytes.y / 127.5};
}

double sample_density(const Style::Density& map, const glm::dvec2& uv) {
  if (map.value.empty()) return 1.0;
  // The top row of the picture is at v = 1.
  const double x = std::clamp(uv.x * map.width - 0.5, 0.0, double(map.width - 1));
  const double y = std::clamp((1.0 - uv.y) * map.height - 0.5, 0.0, double(map.height - 1));
  const double s = x - std::floor(x), t = y - std::floor(y);
  double sum = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    const int right = corner % 2, down = corner / 2;
    const std::size_t i = std::size_t(std::min(int(x) + right, map.width - 1));
    const std::size_t j = std::size_t(std::min(int(y) + down, map.height - 1));
    sum += (right ? s : 1.0 - s) * (down ? t : 1.0 - t) * double(map.value[j * std::size_t(map.width) + i]);
  }
  return sum;
}

glm::dvec3 sample_coat(const CoatTexture& coat, const glm::dvec2& uv) {
  return bilinear(coat.size, uv,
                  [&](std::size_t j, std::size_t i) {
                    const auto& bytes = coat.texel[j * std::size_t(coat.size) + i];
                    return glm::dvec3(double(bytes[0]), double(bytes[1]), double(bytes[2]));
                  }) /
         255.0;
}

}  // namespace pelage::reference
