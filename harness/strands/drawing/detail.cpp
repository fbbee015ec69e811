#include "harness/strands/drawing/detail.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace pelage::strands {
namespace {

constexpr std::size_t fading_part = 8;  // at most this part (1 / 8) of the drawn strands fades
constexpr double farthest = 0.25;       // greatest distance between the curve and its segments, pixels
constexpr int least_segments = 3;
constexpr float least_fraction = 0.001f;

// Constants of overlap_factor(), fitted to pictures of bunny, horse and torus (docs/strands.md).
constexpr double overlap = 0.55, overlap_range = 1.5, pixel_blur = 1.2;

/// Returns by how much the overlap of `count` strands of the mean width `width` (R) is below that of strands
/// at independent random places. `pixel` is the side of a pixel in R.
double missing_overlap(double count, double width, double area, double pixel) {
  const double spacing = std::sqrt(area / count), blurred = std::hypot(width, pixel_blur * pixel);
  return overlap * width / blurred * (1 - std::exp(-overlap_range * blurred / spacing));
}

/// Returns the side of a pixel at the view depth of the object's origin, R.
double pixel_at_origin(const Camera& camera) {
  return double(camera.pixel) * std::max(double(camera.row_w.w), double(camera.near));
}

}  // namespace

Pruning pruning_of(std::size_t strands, const Look& look) {
  const auto wanted = std::size_t(std::ceil(double(look.fraction) * double(strands)));
  const std::size_t drawn = std::clamp(wanted, std::size_t(1), strands);
  const std::size_t fading = std::max(std::size_t(1), std::min(drawn / fading_part, strands - drawn));
  // The factors of the thinner strands are 1 / fading, 2 / fading, ..., 1.
  const double sum = double(drawn) - 0.5 * double(fading - 1);
  return {int(drawn), float(double(look.width_factor) * double(strands) / sum), float(1 / double(fading))};
}

Spread spread_of(const std::vector<KeyedStrand>& strands, const Mesh& mesh) {
  double width = 0, area = 0;
  for (const KeyedStrand& strand : strands) width += double(strand.width);
  for (const glm::uvec3& t : mesh.triangle)
    area += 0.5 * double(glm::length(glm::cross(mesh.position[t[1]] - mesh.position[t[0]],
                                                mesh.position[t[2]] - mesh.position[t[0]])));
  return {strands.size(), float(width / double(std::max<std::size_t>(1, strands.size()))), float(area)};
}

float overlap_factor(const Camera& camera, const Look& look, const Spread& spread) {
  if (!(look.fraction < 1) || spread.strands == 0 || !(spread.area > 0)) return 1;
  const double pixel = pixel_at_origin(camera), width = double(spread.width) * (1 - double(look.taper) / 2);
  const auto missing = [&](double fraction) {
    return 1 + double(look.opacity) * missing_overlap(fraction * double(spread.strands), width / fraction,
                                                      double(spread.area), pixel);
  };
  return float(missing(1) / missing(double(look.fraction)));
}

float fraction_on_screen(const Camera& camera, const Spread& spread, float least_width) {
  if (!(least_width > 0)) return 1;
  const double pixels = double(spread.width) / pixel_at_origin(camera);
  return std::clamp(float(pixels / double(least_width)), least_fraction, 1.0f);
}

int segments_on_screen(const Camera& camera, const DepthRange& range, float length, int most) {
  const double pixels = double(length) / (double(camera.pixel) * double(range.nearest));
  // The distance between a quadratic curve and n chords of equal parameters is |P0 - 2 P1 + P2| / (4 n^2).
  const double bend = pixels * std::numbers::sqrt2 / 2;
  const double needed = std::ceil(std::sqrt(bend / (4 * farthest)));
  return std::min(most, int(std::clamp(needed, double(least_segments), 7.0)));
}

}  // namespace pelage::strands
