#include "harness/compare/masks.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "harness/compare/tolerances.hpp"

namespace pelage {

std::vector<Check> check_mask(const std::vector<glm::vec4>& ours, const std::vector<glm::vec4>& reference) {
  if (ours.size() != reference.size())
    throw std::invalid_argument("check_mask: the masks have different sizes");
  double worst = 0, other = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const glm::vec4 a = ours[i], b = reference[i];
    if ((a.w > 0) != (b.w > 0)) {
      ++other;
      continue;
    }
    for (int c = 0; c < 4; ++c) {
      const double error = std::abs(double(a[c]) - double(b[c]));
      worst = std::isfinite(error) ? std::max(worst, error) : 1e6;
    }
  }
  return {{against_reference, "texels wet in only one mask", other, 0, false},
          {against_reference, "largest texel error", worst, tolerance::mask_texel, false}};
}

}  // namespace pelage
