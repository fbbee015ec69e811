#include "harness/mesh/chart_places.hpp"

#include <algorithm>
#include <cmath>

namespace pelage {
namespace {

constexpr int side = 1024;         // cells per side of the square
constexpr int texel = side / 256;  // cells per texel of a wetness mask of 256 x 256 texels
constexpr int margin = 2 * texel;  // from the border of the square
constexpr int gap = 4 * texel;     // between charts
constexpr std::size_t corners = side + 1;

int cell_of(double x) {
  return std::clamp(int(std::floor(x * side)), 0, side - 1);
}

}  // namespace

FreeSpace::FreeSpace() : taken_(std::size_t(side) * side, 0), sum_(corners * corners, 0) {}

void FreeSpace::take(const Surface::Corners& uv) {
  const auto [left, right] = std::minmax({uv[0].x, uv[1].x, uv[2].x});
  const auto [low, high] = std::minmax({uv[0].y, uv[1].y, uv[2].y});
  for (int y = cell_of(low); y <= cell_of(high); ++y)
    for (int x = cell_of(left); x <= cell_of(right); ++x) taken_[std::size_t(y) * side + std::size_t(x)] = 1;
  summed_ = false;
}

void FreeSpace::sum_up() {
  for (std::size_t y = 0; y < side; ++y) {
    int row = 0;
    for (std::size_t x = 0; x < side; ++x) {
      row += taken_[y * side + x];
      sum_[(y + 1) * corners + x + 1] = sum_[y * corners + x + 1] + row;
    }
  }
  summed_ = true;
}

bool FreeSpace::is_free(int x, int y, int width, int height) const {
  const auto at = [&](int i, int j) {
    return sum_[std::size_t(std::clamp(j, 0, side)) * corners + std::size_t(std::clamp(i, 0, side))];
  };
  return at(x + width, y + height) - at(x, y + height) - at(x + width, y) + at(x, y) == 0;
}

std::optional<glm::dvec2> FreeSpace::place(glm::dvec2 size) {
  if (!summed_) sum_up();
  const int width = int(std::ceil(size.x * side)), height = int(std::ceil(size.y * side));
  for (int y = margin; y + height <= side - margin; y += texel) {
    for (int x = margin; x + width <= side - margin; x += texel) {
      if (!is_free(x - gap, y - gap, width + 2 * gap, height + 2 * gap)) continue;
      for (int j = y; j < y + height; ++j)
        std::fill_n(taken_.begin() + std::ptrdiff_t(j) * side + x, width, char(1));
      summed_ = false;
      return glm::dvec2(x, y) / double(side);
    }
  }
  return {};
}

}  // namespace pelage
