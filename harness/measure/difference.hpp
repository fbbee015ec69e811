// A statistical test of the difference between two sets of timings of one case. The unit of observation is
// the process: samples of one process share memory layout and clock rate, so they are not independent.
#pragma once
#include <span>
#include <vector>

#include "harness/measure/statistics.hpp"

namespace pelage {

/// The timings of one case by separate processes.
struct Timings {
  std::vector<std::vector<double>> processes;  ///< wall times of frames in ms, one list per process
  /// Start of each process in seconds since 1970; empty if unknown.
  std::vector<double> started_s = {};
};

/// A variance between processes is estimated from at least this number of processes. With fewer processes,
/// the test assumes that the medians of processes have the relative standard deviation `assumed_spread`. This
/// is a cautious value: results/ contains processes of the same case whose medians differ by 6.5%.
inline constexpr std::size_t fewest_processes = 3;
inline constexpr double assumed_spread = 0.07;

/// An estimate of ln(b / a), where a and b are the typical times of the two sets.
struct Difference {
  double log_ratio = 0;  ///< mean of the logarithms of the processes' medians in b, minus the mean in a
  double error = 0;      ///< standard error of log_ratio
  double degrees = 0;    ///< degrees of freedom of Student's distribution; infinity for the normal one
  bool paired = false;   ///< whether the processes of a and b took turns
  bool assumed = false;  ///< whether `error` contains assumed_spread
};

/// Estimates the difference from the medians of the processes. If the processes of both sets took turns (an
/// equal number, at least fewest_processes; in the order of their starts, each first and second process
/// belong to different sets), the test uses the differences within the pairs (paired t-test). Otherwise it
/// uses both variances (Welch's t-test). Needs at least one process with one sample in each set.
Difference difference_of(const Timings& a, const Timings& b);

/// Returns the interval of b / a with this confidence.
Interval ratio_interval(const Difference& difference, double confidence);

enum class Side { below, within, above, undecided };

/// Position of b / a relative to the limits 1 - threshold and 1 + threshold.
struct Decision {
  Side side = Side::undecided;
  double p = 1;           ///< two-sided p-value of the nearest limit, before Holm's correction
  double confidence = 0;  ///< of `ratio`
  Interval ratio;         ///< interval of b / a; decides the side
};

/// Decides on which side of the limits each b / a lies. The probability that one or more of the decisions is
/// wrong is at most `alpha` (Holm's method, as for the claims). With the threshold 0 no ratio is `within`.
std::vector<Decision> decide(std::span<const Difference> differences, double threshold, double alpha);

/// Returns the smallest increase of b / a above 1 that decide() would find with the probability `power` among
/// `count` differences, if the limit of the first step of Holm's method applies: 0.05 is 5%.
double detectable_change(const Difference& difference, std::size_t count, double threshold, double alpha,
                         double power = 0.9);

}  // namespace pelage
