// The result of a check. A check compares one quantity of a measured frame with a trusted result.
#pragma once
#include <string>

namespace pelage {

/// Check::against has this value if the frame is compared with the double-precision reference.
inline constexpr const char* against_reference = "reference";

/// One comparison of the timed frame with a trusted result. The check holds if `value` is within `limit`.
/// `at_least` selects whether `limit` is a lower or an upper limit.
struct Check {
  std::string against;  ///< name of the trusted result, such as against_reference
  std::string metric;   ///< name of the compared quantity: "psnr", "p99.9", ...
  double value, limit;
  bool at_least;  ///< true: value >= limit is required; false: value <= limit
  bool holds() const { return at_least ? value >= limit : value <= limit; }
};

}  // namespace pelage
