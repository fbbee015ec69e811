// Computes a verdict from the bootstrap draws of one or several effects.
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
  /// Index of the decisive estimate. If the claim fails, this is the worst estimate outside the region. If
  /// the claim is undecided, it is the worst undecided estimate. Otherwise it is the estimate nearest to a
  /// limit.
  std::size_t decisive = 0;
  Interval interval;         ///< percentile interval of the decisive estimate
  double confidence = 0.95;  ///< of `interval`; above 0.95 where Holm's correction demands it
};

/// Decides whether all effects lie in the region. Holm's method limits the probability that any of the m
/// decisions is wrong to 5%. The effects are ordered by their p-value. The k-th effect (from k = 1) is
/// decided if its interval with the confidence 1 - 0.05 / (m - k + 1) lies wholly inside or wholly outside
/// the region. The first effect that is not decided ends the procedure. The claim fails if the
/// procedure decides that an effect lies outside. It holds if the procedure decides that all effects lie
/// inside. Otherwise it is undecided. With
/// one effect, the 95% interval decides.
Decision decide(const std::vector<Estimate>& estimates, const Region& region);

/// Largest number of effects for which judge() calls decide() with separate effects. It bounds the number of
/// draws, and so the time and the memory.
inline constexpr std::size_t most_effects = 200;

/// Returns the number of bootstrap draws that the intervals need for Holm's correction of `effects` effects.
int draws_for(std::size_t effects);

/// Returns the distance of the value from the nearest limit of the region: positive if the value is inside
/// the region, negative if it is outside.
double margin(const Region& region, double value);

}  // namespace pelage::claims
