// The tips of Silva's strands against the reference's.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/compare/check.hpp"

namespace pelage {

/// Distances of tips, as a fraction of the strand's length; one that is not finite counts as 10^6.
struct TipErrors {
  double p999 = 0;  ///< 99.9th percentile
  double worst = 0;
};
/// `length`: of a strand, R. Tips in R, relative to their roots. Throws std::invalid_argument where the
/// counts differ or are 0.
TipErrors tip_errors(double length, const std::vector<glm::vec3>& ours,
                     const std::vector<glm::vec3>& reference);

/// Holds the largest error to tolerance::worst_tip.
Check check_worst_tip(const TipErrors& errors);

/// Holds the 99.9th percentile to tolerance::usual_tip.
Check check_usual_tip(const TipErrors& errors);

}  // namespace pelage
