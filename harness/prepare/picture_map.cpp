#include "harness/prepare/picture_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/error.hpp"
#include "harness/picture/image_io.hpp"

namespace pelage {
namespace {

/// Rec. 601. The formula returns exactly v for the grey (v, v, v).
float luma_of(glm::vec4 c) {
  return c.y + 0.299f * (c.x - c.y) + 0.114f * (c.z - c.y);
}

double between(double a, double b, double t) {
  return a + t * (b - a);
}

}  // namespace

PictureMap::PictureMap(const std::filesystem::path& path) : picture_(read_picture(path)) {
  for (const glm::vec4& p : picture_.pixel)
    if (!(std::isfinite(p.x + p.y + p.z) && p.x >= 0 && p.y >= 0 && p.z >= 0))
      throw InputError(fmt::format(
          "{}: a pixel has a colour value that is negative, infinite or not a number; colour values must be finite and at least 0",
          path.string()));
}

glm::vec4 PictureMap::at(glm::dvec2 uv) const {
  const double px = std::clamp(uv.x * width() - 0.5, 0.0, width() - 1.0);
  const double py = std::clamp((1.0 - uv.y) * height() - 0.5, 0.0, height() - 1.0);
  const int x0 = int(px), y0 = int(py);
  const int x1 = std::min(x0 + 1, width() - 1), y1 = std::min(y0 + 1, height() - 1);
  const float u = float(px - x0), v = float(py - y0);
  return (1 - v) * ((1 - u) * picture_.at(x0, y0) + u * picture_.at(x1, y0)) +
         v * ((1 - u) * picture_.at(x0, y1) + u * picture_.at(x1, y1));
}

PictureMap map_of(const std::filesystem::path& path, const std::string& key) {
  try {
    return PictureMap(path);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", key, error.what()));
  }
}

LumaMap::LumaMap(const std::filesystem::path& path, const std::string& key) {
  if (path.empty()) return;
  const PictureMap map = map_of(path, key);
  width_ = map.width();
  height_ = map.height();
  luma_.reserve(map.picture().pixel.size());
  for (const glm::vec4& pixel : map.picture().pixel) {
    const float value = luma_of(pixel);
    if (value > 1)
      throw InputError(fmt::format("{}: {}: a pixel has the luma {}; the luma of a map must be at most 1",
                                   key, path.string(), value));
    luma_.push_back(value);
  }
}

double LumaMap::most() const {
  return constant() ? 1 : double(*std::max_element(luma_.begin(), luma_.end()));
}

double LumaMap::at(glm::dvec2 uv) const {
  if (constant()) return 1;
  const double px = std::clamp(uv.x * width_ - 0.5, 0.0, width_ - 1.0);
  const double py = std::clamp((1.0 - uv.y) * height_ - 0.5, 0.0, height_ - 1.0);
  const int x = int(px), y = int(py), right = std::min(x + 1, width_ - 1),
            below = std::min(y + 1, height_ - 1);
  const auto pixel = [&](int i, int j) {
    return double(luma_[std::size_t(j) * std::size_t(width_) + std::size_t(i)]);
  };
  return between(between(pixel(x, y), pixel(right, y), px - x),
                 between(pixel(x, below), pixel(right, below), px - x), py - y);
}

bool LumaMap::reaches(glm::dvec2 low, glm::dvec2 high, float least) const {
  if (constant()) return true;
  const auto pixel = [](double place, int size) { return int(std::clamp(place, 0.0, size - 1.0)); };
  const int x0 = pixel(low.x * width_ - 0.5, width_), x1 = pixel(high.x * width_ + 0.5, width_);
  const int y0 = pixel((1 - high.y) * height_ - 0.5, height_),
            y1 = pixel((1 - low.y) * height_ + 0.5, height_);
  for (int y = y0; y <= y1; ++y) {
    const float* row = luma_.data() + std::size_t(y) * std::size_t(width_);
    if (std::any_of(row + x0, row + x1 + 1, [&](float value) { return value >= least; })) return true;
  }
  return false;
}

}  // namespace pelage
