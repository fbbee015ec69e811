#include "harness/compare/masses.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "harness/compare/tolerances.hpp"

namespace pelage::springs {

Spread spread(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b, double length) {
  if (a.size() != b.size() || a.empty())
    throw std::invalid_argument("spread(): the two lists of masses have different sizes or are empty");
  std::vector<double> error;
  error.reserve(a.size());
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = glm::distance(glm::dvec3(a[i]), glm::dvec3(b[i])) / length;
    error.push_back(d < 1e9 ? d : 1e9);
    squares += error.back() * error.back();
  }
  std::sort(error.begin(), error.end());
  return {std::sqrt(squares / double(error.size())), error[error.size() * 99 / 100], error.back()};
}

std::vector<Check> agreement_checks(Kind kind, const std::string& against, const Spread& found) {
  if (kind.shared_edges())
    return {{against, "rms", found.rms, tolerance::prisms_rms, false},
            {against, "p99", found.percentile_99, tolerance::prisms_p99, false}};
  return {{against, "worst", found.worst, tolerance::stick_top, false}};
}

}  // namespace pelage::springs
