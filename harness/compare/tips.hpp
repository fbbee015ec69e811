// Compares the tips of Silva's strands with the reference's tips. The unit of length is R, the radius of the
// mesh's bounding sphere.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/record/check.hpp"

namespace pelage {

/// Distances between tips, as fractions of the strand's length. A distance that is not finite counts as 10^6.
struct TipErrors {
  double p999 = 0;  ///< 99.9th percentile
  double worst = 0;
};
/// Compares two lists of tips (positions relative to the roots, in R). `length` is the length of a strand in
/// R. Throws std::invalid_argument if the sizes differ or are 0.
TipErrors tip_errors(double length, const std::vector<glm::vec3>& ours,
                     const std::vector<glm::vec3>& reference);

/// Checks TipErrors::worst against tolerance::worst_tip.
Check check_worst_tip(const TipErrors& errors);

/// Checks TipErrors::p999 against tolerance::usual_tip.
Check check_usual_tip(const TipErrors& errors);

}  // namespace pelage
