// Pictures in memory.
#pragma once
#include <cstddef>
#include <glm/vec4.hpp>
#include <vector>

namespace pelage {

/// A rectangle of pixels. (x, y) is its top left pixel.
struct Window {
  int x, y, width, height;
};

/// RGBA floats, top row first. The colours are gamma-encoded, as in the papers that docs/shells.md lists.
/// Alpha is 0 on the background, 1 on the base surface, and the coverage of the fur elsewhere. The colour is
/// already composited over the background. Values are not clamped.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<glm::vec4> pixel;
  /// What a PNG file that was read says of its colours (chunk gAMA): the intensity is the value to the power
  /// of `gamma`. 0: nothing, or what screens show.
  float gamma = 0;
  const glm::vec4& at(int x, int y) const {
    return pixel[std::size_t(y) * std::size_t(width) + std::size_t(x)];
  }
  glm::vec4& at(int x, int y) { return pixel[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

}  // namespace pelage
