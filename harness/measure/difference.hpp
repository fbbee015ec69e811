// A statistical test of the difference between two sets of timings of one case. The test uses one value per
// process, the median of its samples, because samples of one process share memory layout and clock rate, so
// they are not independent.
#pragma once
#include <span>
#include <vector>

#include "harness/measure/statistics.hpp"

namespace pelage {

/// The timings of one case, measured by one or more processes.
struct Timings {
  std::vector<std::vector<double>> processes;  ///< wall times of frames in ms, one list per process
  /// Start of each process in seconds since 1970; empty if unknown.
  std::vector<double> started_s = {};
};

/// If a set has at least `fewest_processes` processes, the test estimates the variance between them. If it
/// has fewer, the test assumes that their medians have the relative standard deviation `assumed_spread`. The
/// times of separate processes in results/ have 6.2% (experiments/claims.toml).
inline constexpr std::size_t fewest_processes = 3;
inline constexpr double assumed_spread = 0.07;

/// Returns the geometric mean of the processes' medians in ms. Each process needs at least one sample.
double typical_ms(const Timings& timings);

/// An estimate of ln(b / a), where a and b are the typical times of the two sets.
struct Difference {
  double log_ratio;  ///< mean logarithm of the medians in b, minus mean logarithm of the medians in a
  double error;      ///< standard error of log_ratio
  double degrees;    ///< degrees of freedom of Student's t; infinity: normal distribution
  bool paired;       ///< whether the processes of a and b took turns, so that a paired t-test was used
  bool assumed;      ///< whether `error` contains assumed_spread
};

/// Estimates the difference from the medians of the processes: within pairs (paired t-test) if the processes
/// of both sets took turns, otherwise with the variances of both sets (Welch's t-test). They took turns if
/// both sets have the same number of processes, at least fewest_processes, and each pair of consecutive
/// processes by start time contains one of each set. Each set needs at least one process with one sample.
Difference difference_of(const Timings& a, const Timings& b);

/// Returns the confidence interval of the ratio b / a at the level `confidence`, such as 0.95.
Interval ratio_interval(const Difference& difference, double confidence);

enum class Side { below, within, above, undecided };

/// Whether b / a is below, within or above the limits 1 - threshold and 1 + threshold.
struct Decision {
  Side side;
  double p;           ///< two-sided p-value for "b / a equals the nearest limit", before Holm's correction
  double confidence;  ///< confidence level of the interval `ratio`
  Interval ratio;     ///< confidence interval of b / a at the level `confidence`
};

/// Decides for each difference. The probability that one or more of the decisions are wrong is at most
/// `alpha` (Holm's method). If the threshold is 0, no decision is `within`.
std::vector<Decision> decide(std::span<const Difference> differences, double threshold, double alpha);

/// Returns the smallest relative increase from a to b (0.05 is 5%) that decide() detects with the probability
/// `power` if it decides about `count` differences together, in the strictest step of Holm's method.
double detectable_change(const Difference& difference, std::size_t count, double threshold, double alpha,
                         double power = 0.9);

/// Returns the number of processes per set, now `processes`, with which decide() would reach a decision about
/// one of `count` differences with the probability `power`, if the estimated difference is the true one, the
/// standard deviation of the processes' medians does not change, and the processes take turns. Returns 0 if
/// more than 1000 are needed, or if the standard deviation is assumed, not measured.
std::size_t processes_needed(const Difference& difference, std::size_t processes, std::size_t count,
                             double threshold, double alpha, double power = 0.9);

}  // namespace pelage
