// Tries the statistical test of `pelage compare` on real timings whose true difference is known, and counts
// the verdicts of the test.
#pragma once
#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "harness/measure/difference.hpp"

namespace pelage {

/// The wall times of the two sides a and b in one round, in ms, and the times at which their first samples
/// started, in s.
struct RoundTimes {
  std::vector<double> a, b;
  double a_started_s = 0, b_started_s = 0;
};

/// Makes a new rendering pipeline with new buffers for each side, and draws frames with both. If `b_first` is
/// true, side b starts. Warm-up frames are not timed.
using TimeRound = std::function<RoundTimes(bool b_first)>;

/// Settings of trials.
struct TrialLimits {
  int rounds = 12;         ///< number of rounds; at least fewest_processes
  double threshold = 0;    ///< see decide()
  double alpha = 0.02;     ///< see decide()
  std::uint64_t seed = 1;  ///< seed of the random order of the two sides in each round
};

struct Trial {
  Difference difference;
  Decision decision;
};

/// Times both sides in every round, and tests whether their times differ. A pipeline of a round takes the
/// place of one process of `pelage run --repeat`.
Trial run_trial(const TimeRound& time_round, const TrialLimits& limits, std::mt19937_64& random);

/// Number of trials for each verdict.
struct TrialCounts {
  int faster = 0, slower = 0, same = 0, undecided = 0;
  int all() const { return faster + slower + same + undecided; }
};
TrialCounts count_of(std::span<const Trial> trials);

/// Returns the 95% confidence interval (Clopper and Pearson) of the probability of an event that occurred in
/// `hits` of `all` trials.
Interval rate_interval(int hits, int all);

/// trials_csv() returns one CSV line per trial, with the text `side` in the first column. trials_csv_header()
/// returns the line with the names of the columns.
std::string trials_csv_header();
std::string trials_csv(const std::string& side, std::span<const Trial> trials);

}  // namespace pelage
