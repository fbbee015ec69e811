// One comparison of what was timed with something trusted.
#pragma once
#include <string>

namespace pelage {

/// Check::against of comparisons with the double-precision reference.
inline constexpr const char* against_reference = "reference";

/// One comparison of the timed frame with something trusted. Holds when `value` keeps to `limit` as
/// `at_least` says.
struct Check {
  std::string against;  ///< "reference", ...
  std::string metric;   ///< "psnr", "p99.9"
  double value = 0;
  double limit = 0;
  bool at_least = true;  ///< value >= limit is good; false: value <= limit is
  bool holds() const { return at_least ? value >= limit : value <= limit; }
};

}  // namespace pelage
