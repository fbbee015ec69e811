// Compares the positions of the masses in two states of a mass-spring topology.
#pragma once
#include "harness/record/check.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// Distances between the positions of a stick's top mass in two states, as fractions of the fur's length.
struct Spread {
  double rms = 0, percentile_99 = 0, worst = 0;
};
/// Compares the positions `a` and `b` of the top masses, one per stick. `length` is the fur's length in the
/// unit of the positions. A distance counts as 1e9 if it is not finite or if it is above 1e9. Throws
/// std::invalid_argument if the sizes differ or are 0.
Spread spread(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b, double length);

/// Returns checks that compare the distances in `found` with their limits. For shared prisms (adjacent prisms
/// share their sticks), the limit of the rms distance is tolerance::prisms_rms, and the limit of the 99th
/// percentile is tolerance::prisms_p99. For all other topologies, the limit of the largest distance is
/// tolerance::stick_top. `against` names the trusted state, for example "reference".
std::vector<Check> agreement_checks(Kind kind, const std::string& against, const Spread& found);

}  // namespace pelage::springs
