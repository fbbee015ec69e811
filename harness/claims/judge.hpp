// Computes verdicts from bootstrap draws, and decides claims from rows of results.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/claims/claim.hpp"
#include "harness/measure/statistics.hpp"
#include "harness/record/results_folder.hpp"

namespace pelage::claims {

enum class Verdict { holds, fails, undecided, untestable };
std::string_view to_text(Verdict verdict);  ///< "holds", "fails", ...

/// A measured effect, and its values in the bootstrap draws.
struct Estimate {
  double value;
  std::vector<double> draws;
};

struct Decision {
  Verdict verdict;
  /// Index of the decisive estimate. If the claim fails, it is the estimate farthest outside the region; if
  /// it is undecided, the undecided estimate with the smallest margin(); if it holds, that nearest to a
  /// limit.
  std::size_t decisive;
  Interval interval;  ///< percentile interval of the decisive estimate
  double confidence;  ///< confidence level of `interval`; Holm's method may demand more than 0.95
};

/// Decides whether all m effects (m = estimates.size()) lie in the region. With Holm's method, the
/// probability that at least one of the m decisions is wrong is at most 5%. In the order of the p-values, the
/// k-th effect (from k = 1) is decided if its interval with the confidence 1 - 0.05 / (m - k + 1) lies wholly
/// inside or wholly outside the region. The first effect that is not decided ends the procedure. The claim
/// fails if an effect is decided to lie outside the region, and holds if all are decided to lie inside;
/// otherwise it is undecided.
Decision decide(const std::vector<Estimate>& estimates, const Region& region);

/// The largest number of effects that judge() decides separately. More need more draws, time and memory.
inline constexpr std::size_t most_effects = 200;

/// Returns the distance of the value from the nearest limit of the region, negative outside it.
double margin(const Region& region, double value);

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
