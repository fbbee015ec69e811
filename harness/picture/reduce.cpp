#include "harness/picture/reduce.hpp"

#include <algorithm>
#include <cmath>

namespace pelage {
namespace {

/// The index of a pixel of the original picture, and the weight of this pixel in the mean that gives a pixel
/// of the reduced picture.
struct Share {
  int pixel;
  float weight;
};

/// Computes how a row or column of `from` pixels is reduced to `to` pixels. Returns, for each reduced pixel,
/// the original pixels that it covers, with their weights.
std::vector<std::vector<Share>> shares_of(int from, int to) {
  std::vector<std::vector<Share>> shares(static_cast<std::size_t>(to));
  const double step = double(from) / to;
  for (int i = 0; i < to; ++i) {
    const double start = i * step, end = std::min(double(from), (i + 1) * step);
    for (int p = int(start); p < from && p < end; ++p)
      if (const double weight = (std::min(end, p + 1.0) - std::max(start, double(p))) / step; weight > 0)
        shares[std::size_t(i)].push_back({p, float(weight)});
  }
  return shares;
}

}  // namespace

Picture reduced(const Picture& picture, int most_width) {
  if (picture.width <= most_width) return picture;
  const int height = std::max(1, int(std::lround(double(picture.height) * most_width / picture.width)));
  const auto columns = shares_of(picture.width, most_width), rows = shares_of(picture.height, height);
  Picture across{most_width, picture.height,
                 std::vector<glm::vec4>(std::size_t(most_width) * std::size_t(picture.height))};
  for (int y = 0; y < across.height; ++y)
    for (int x = 0; x < across.width; ++x)
      for (const Share& share : columns[std::size_t(x)])
        across.at(x, y) += share.weight * picture.at(share.pixel, y);
  Picture result{most_width, height, std::vector<glm::vec4>(std::size_t(most_width) * std::size_t(height))};
  for (int y = 0; y < height; ++y)
    for (const Share& share : rows[std::size_t(y)])
      for (int x = 0; x < most_width; ++x) result.at(x, y) += share.weight * across.at(x, share.pixel);
  return result;
}

}  // namespace pelage
