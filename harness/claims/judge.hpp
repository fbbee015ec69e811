// Decides claims from rows of results.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/claims/claim.hpp"
#include "harness/claims/verdict.hpp"
#include "harness/record/results_folder.hpp"

namespace pelage::claims {

/// A claim with its verdict on one device and host.
struct Judged {
  Claim claim;
  std::string device, host;  ///< "" if there are no rows
  Verdict verdict = Verdict::untestable;
  bool no_rows = false;         ///< true if no row belongs to an experiment of the claim
  std::string reason;           ///< why the verdict is undecided or untestable
  std::optional<double> value;  ///< the effect; for Combine::every the effect of the decisive part
  Interval interval;            ///< confidence interval of `value`
  double confidence = 0.95;     ///< confidence level of `interval`
  std::size_t effects = 0;      ///< number of effects, or of cases for share_of_cases
  double least = 0, most = 0;   ///< smallest and largest effect
  std::string decisive;         ///< for Combine::every with several effects: name of the decisive part
  std::size_t processes = 0;    ///< smallest number of separate processes that measured a case
  /// The effect computed from published frame rates (the metric paper_fps); the interval follows from their
  /// rounding.
  std::optional<double> paper_value;
  Interval paper_interval;
  /// Notes about the rows: cases that are left out, with the reason, and the number of contended rows.
  std::vector<std::string> notes;
};

/// Judges every claim of the file on every device and host that has rows of the claim's experiments. A claim
/// without any row gives one result with the verdict untestable. All rows of a case must have been measured
/// with the same inputs (input_sets()). Equal rows give equal results, although the bootstrap uses random
/// numbers.
std::vector<Judged> judge(const ClaimFile& file, const std::vector<FoundRow>& rows);

}  // namespace pelage::claims
