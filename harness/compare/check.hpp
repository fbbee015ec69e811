// The result of a check.
#pragma once
#include <string>

namespace pelage {

/// Check::against of comparisons with the double-precision reference.
inline constexpr const char* against_reference = "reference";

/// One comparison of the timed frame with a trusted result. It holds if `value` is within `limit`; `at_least`
/// selects the direction.
struct Check {
  std::string against;  ///< trusted result: against_reference, ...
  std::string metric;   ///< quantity compared: "psnr", "p99.9", ...
  double value = 0;
  double limit = 0;
  bool at_least = true;  ///< true: value >= limit is required; false: value <= limit
  bool holds() const { return at_least ? value >= limit : value <= limit; }
};

}  // namespace pelage
