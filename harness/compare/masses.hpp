// How far two states of one topology are apart.
#pragma once
#include "harness/compare/check.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// Distances of the tops as fractions of the fur's length; 1e9 where a value is no number.
struct Spread {
  double rms = 0, percentile_99 = 0, worst = 0;
};
/// Throws std::invalid_argument where the counts differ.
Spread spread(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b, double length);

/// What a row is held to: shared prisms to tolerance::prisms_rms and tolerance::prisms_p99, the others
/// everywhere to tolerance::stick_top.
std::vector<Check> agreement_checks(Kind kind, const std::string& against, const Spread& found);

}  // namespace pelage::springs
