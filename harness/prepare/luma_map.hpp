// A map: a picture in UV space with one value per pixel, which varies a value over the surface.
#pragma once
#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "harness/prepare/picture_map.hpp"

namespace pelage {

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
