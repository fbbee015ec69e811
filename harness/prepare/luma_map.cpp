#include "harness/prepare/luma_map.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/error.hpp"

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
