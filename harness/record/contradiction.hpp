// Refuses rows whose fields contradict each other. A correct checksum does not exclude contradictions: a
// person may edit a row and then compute its checksum again.
#pragma once
#include <span>

#include "harness/record/row.hpp"

namespace pelage {

/// The weakest limit that any version of pelage has used for a check of a picture
/// (harness/compare/tolerances.hpp).
struct WeakestLimit {
  const char* metric;
  double limit;
  bool at_least;
};
std::span<const WeakestLimit> weakest_limits();

/// Throws InputError, with the contradiction, if checks, times, metrics, hashes or names of the row
/// contradict each other or the status. Medians are compared with tolerances. If the row lacks a field,
/// nothing is compared with it.
void refuse_contradiction(const Row& row);

}  // namespace pelage
