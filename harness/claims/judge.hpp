// Decides claims from rows of results. A row contains the measurements of one case in one process.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/claims/claim.hpp"
#include "harness/claims/verdict.hpp"
#include "harness/record/results_folder.hpp"

namespace pelage::claims {

/// A claim with its verdict on one device and host. A part of a claim is the group of cells from which one
/// effect is computed (effects.hpp). With Combine::every, the effect of each part must be inside
/// Claim::region. Decision::decisive (verdict.hpp) is then the index of the decisive part.
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
  /// The effect computed from published frame rates (the metric paper_fps of the rows). `paper_interval`
  /// follows from the rounding of the published numbers.
  std::optional<double> paper_value;
  Interval paper_interval;
  /// Notes about the rows: the cases that are left out, with the reason, and the number of rows that were
  /// measured while other processes used the CPU.
  std::vector<std::string> notes;
};

/// Judges every claim of the file on every device and host that has rows of the claim's experiments. A claim
/// without any row gives one result with the verdict untestable. All rows of a case must have been measured
/// with the same inputs (input_sets()). Equal rows give equal results, although the bootstrap uses random
/// numbers.
std::vector<Judged> judge(const ClaimFile& file, const std::vector<FoundRow>& rows);

}  // namespace pelage::claims
