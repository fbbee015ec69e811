#include "harness/compare/ssim.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/error.hpp"

namespace pelage {
namespace {

double luma(const glm::vec4& pixel) {
  return std::clamp(0.299 * double(pixel.x) + 0.587 * double(pixel.y) + 0.114 * double(pixel.z), 0.0, 1.0);
}

/// Returns the SSIM of one window.
double similarity(const Picture& a, const Picture& b, int left, int top, int side) {
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  for (int y = top; y < top + side; ++y)
    for (int x = left; x < left + side; ++x) {
      const double p = luma(a.at(x, y)), q = luma(b.at(x, y));
      sum_a += p;
      sum_b += q;
      aa += p * p;
      bb += q * q;
      ab += p * q;
    }
  const double count = double(side) * double(side), mean_a = sum_a / count, mean_b = sum_b / count;
  const double var_a = aa / count - mean_a * mean_a, var_b = bb / count - mean_b * mean_b;
  const double covariance = ab / count - mean_a * mean_b;
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  return (2 * mean_a * mean_b + c1) * (2 * covariance + c2) /
         ((mean_a * mean_a + mean_b * mean_b + c1) * (var_a + var_b + c2));
}

bool has_fur(const Picture& picture, int left, int top, int side) {
  for (int y = top; y < top + side; ++y)
    for (int x = left; x < left + side; ++x)
      if (picture.at(x, y).w > 0.0f) return true;
  return false;
}

}  // namespace

double ssim(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height)
    throw InputError(fmt::format("pictures of {} x {} and {} x {} pixels cannot be compared", a.width,
                                 a.height, b.width, b.height));
  constexpr int side = 8, step = 4;
  double sum = 0;
  int count = 0;
  for (int y = 0; y + side <= a.height; y += step)
    for (int x = 0; x + side <= a.width; x += step) {
      if (!has_fur(a, x, y, side) && !has_fur(b, x, y, side)) continue;
      sum += similarity(a, b, x, y, side);
      ++count;
    }
  return count > 0 ? sum / count : 1.0;
}

}  // namespace pelage
