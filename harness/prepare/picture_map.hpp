// Picture files in UV space: the coat, and the maps that vary a value such as the fur's length over the
// surface.
#pragma once
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

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

/// A picture as a function of the UV, with one value per pixel.
class LumaMap {
 public:
  /// A map that is 1 everywhere.
  LumaMap() = default;
  /// The luma (Rec. 601) of the picture's pixels. An empty path gives a map that is 1 everywhere. Throws
  /// InputError with the name of the scene key if the picture cannot be read.
  LumaMap(const std::filesystem::path& path, const std::string& key);

  bool constant() const { return luma_.empty(); }
  int width() const { return width_; }
  int height() const { return height_; }
  const std::vector<float>& luma() const { return luma_; }  ///< rows from the top; empty: constant()
  double most() const;                                      ///< the largest value of a pixel
  /// Returns the value at `uv`, by bilinear interpolation as in PictureMap::at(). If all pixels have the same
  /// value, the result is exactly this value.
  double at(glm::dvec2 uv) const;
  /// Returns 2 v - 1 for the value v at `uv`; 1 if there is no picture.
  double sign_at(glm::dvec2 uv) const { return constant() ? 1 : 2 * at(uv) - 1; }
  /// Returns false only if the map is below `least` in the whole rectangle of UV space.
  bool reaches(glm::dvec2 low, glm::dvec2 high, float least) const;

 private:
  int width_ = 0, height_ = 0;
  std::vector<float> luma_;  ///< rows from the top; empty: a map that is 1 everywhere
};

/// Reads a picture. The message of an InputError begins with the name of the scene key.
PictureMap map_of(const std::filesystem::path& path, const std::string& key);

}  // namespace pelage
