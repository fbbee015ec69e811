// A picture file in UV space, such as a coat or a map of the fur's length.
#pragma once
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "harness/picture/picture.hpp"

namespace pelage {

class PictureMap {
 public:
  /// Reads the picture. Throws InputError as read_picture() does, and if a colour value of a pixel is
  /// negative, infinite or not a number.
  explicit PictureMap(const std::filesystem::path& path);

  int width() const { return picture_.width; }
  int height() const { return picture_.height; }
  const Picture& picture() const { return picture_; }

  /// Returns the RGBA value at `uv`, by bilinear interpolation between pixel centres. The picture covers the
  /// unit square, and its top row is at v = 1. Outside the square, the value is that of the nearest point of
  /// the square.
  glm::vec4 at(glm::dvec2 uv) const;

 private:
  Picture picture_;
};

}  // namespace pelage
