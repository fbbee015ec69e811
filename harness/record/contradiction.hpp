// Refuses rows whose fields contradict each other. A correct checksum does not exclude contradictions: a
// person may edit a row and then compute its checksum again.
#pragma once
#include <array>

#include "harness/record/row.hpp"

namespace pelage {

/// The weakest limits of a picture's checks that any version of pelage has recorded. A row with weaker limits
/// is edited. The limits that are used today stand in harness/compare/tolerances.hpp.
struct WeakestLimit {
  const char* metric;
  double limit;
  bool at_least;
};
inline constexpr std::array<WeakestLimit, 3> weakest_limits{
    {{"psnr", 55, true}, {"p99.9", 2.0 / 255, false}, {"flips", 1e-3, false}}};

/// Throws InputError, with the contradiction, if checks, times, metrics, hashes or names of the row
/// contradict each other or the status. Medians are compared with tolerances. If the row lacks a field,
/// nothing is compared with it.
void refuse_contradiction(const Row& row);

}  // namespace pelage
