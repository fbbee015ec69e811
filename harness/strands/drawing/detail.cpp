#include "harness/strands/drawing/detail.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelage::strands {
namespace {

constexpr std::size_t fading_part = 8;  // at most this part (1 / 8) of the drawn strands fades
constexpr double farthest = 0.25;       // greatest distance between the curve and its segments, pixels
constexpr int least_segments = 3;

}  // namespace

Pruning pruning_of(std::size_t strands, float fraction) {
  const auto wanted = std::size_t(std::ceil(double(fraction) * double(strands)));
  const std::size_t drawn = std::clamp(wanted, std::size_t(1), strands);
  const std::size_t fading = std::max(std::size_t(1), std::min(drawn / fading_part, strands - drawn));
  // The factors of the thinner strands are 1 / fading, 2 / fading, ..., 1.
  const double sum = double(drawn) - 0.5 * double(fading - 1);
  return {int(drawn), float(double(strands) / sum), float(1 / double(fading))};
}

int segments_on_screen(const Camera& camera, const DepthRange& range, float length, int most) {
  const double pixels = double(length) / (double(camera.pixel) * double(range.nearest));
  // The distance between a quadratic curve and n chords of equal parameters is |P0 - 2 P1 + P2| / (4 n^2).
  const double bend = pixels * std::numbers::sqrt2 / 2;
  const double needed = std::ceil(std::sqrt(bend / (4 * farthest)));
  return std::min(most, int(std::clamp(needed, double(least_segments), 7.0)));
}

}  // namespace pelage::strands
