// From the drawn values of one or several effects to a verdict.
#pragma once
#include <string_view>
#include <vector>

#include "harness/claims/claim.hpp"
#include "harness/measure/statistics.hpp"

namespace pelage::claims {

enum class Verdict { holds, fails, undecided, untestable };
std::string_view to_text(Verdict verdict);  ///< "holds", "fails", ...

/// An effect as measured, and its values in the draws of the bootstrap.
struct Estimate {
  double value = 0;
  std::vector<double> draws;
};

struct Decision {
  Verdict verdict = Verdict::undecided;
  /// Index of the estimate that decides: of the worst one outside the region if the claim fails, of the worst
  /// undecided one if it is undecided, else of the one nearest to a limit.
  std::size_t decisive = 0;
  Interval interval;         ///< percentile interval of the decisive estimate
  double confidence = 0.95;  ///< of `interval`; above 0.95 where Holm's correction demands it
};

/// Decides whether all effects lie in the region. With m effects, Holm's method keeps the probability that
/// any of the decisions is wrong at most 5%: the effects are ordered by their p-value, and the k-th of them
/// (from k = 1) is decided if its interval with the confidence 1 - 0.05 / (m - k + 1) lies inside or outside
/// the region. The first effect that is not decided ends the procedure. The claim fails if an effect is
/// decided to lie outside, holds if all are decided to lie inside, and is undecided otherwise. For one effect
/// this is the 95% interval.
Decision decide(const std::vector<Estimate>& estimates, const Region& region);

/// Largest number of effects that decide() can separate. It bounds the number of draws, and with it time and
/// memory.
inline constexpr std::size_t most_effects = 200;

/// Returns the number of draws that intervals of `effects` effects need with Holm's correction.
int draws_for(std::size_t effects);

/// Returns how far the value is from the nearest limit inside the region (above 0), or from the region
/// (below 0).
double margin(const Region& region, double value);

}  // namespace pelage::claims
