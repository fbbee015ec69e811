// A picture in memory.
#pragma once
#include <cstddef>
#include <glm/vec4.hpp>
#include <vector>

namespace pelage {

/// A rectangle of pixels; (x, y) is its top left one.
struct Window {
  int x, y, width, height;
};

/// RGBA floats in the papers' gamma space, top row first. Alpha is 0 on pure background, 1 on the base
/// surface and in between the fur's coverage; colour already includes the background. Values are not clamped.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<glm::vec4> pixel;
  const glm::vec4& at(int x, int y) const {
    return pixel[std::size_t(y) * std::size_t(width) + std::size_t(x)];
  }
  glm::vec4& at(int x, int y) { return pixel[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

}  // namespace pelage
