#include "harness/compare/tips.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "harness/compare/tolerances.hpp"

namespace pelage {

TipErrors tip_errors(double length, const std::vector<glm::vec3>& ours,
                     const std::vector<glm::vec3>& reference) {
  if (ours.size() != reference.size() || ours.empty())
    throw std::invalid_argument("tip_errors(): the two lists of tips have different sizes or are empty");
  std::vector<double> errors(ours.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double error = glm::length(glm::dvec3(ours[i]) - glm::dvec3(reference[i]));
    errors[i] = std::isfinite(error) ? error / length : 1e6;
  }
  std::sort(errors.begin(), errors.end());
  return {errors[errors.size() * 999 / 1000], errors.back()};
}

Check check_worst_tip(const TipErrors& errors) {
  return {against_reference, "largest tip error / L0", errors.worst, tolerance::worst_tip, false};
}

Check check_usual_tip(const TipErrors& errors) {
  return {against_reference, "99.9th percentile of tip errors / L0", errors.p999, tolerance::usual_tip,
          false};
}

}  // namespace pelage
