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

/// Makes a new rendering pipeline with new buffers, draws frames with it, and returns one or more wall times
/// in ms. Warm-up frames are not timed.
using TimePipeline = std::function<std::vector<double>()>;

/// Settings of trials. In each round of a trial, run_trial() makes one pipeline with each of two functions.
struct TrialLimits {
  int rounds = 20;         ///< number of rounds; at least fewest_processes
  double threshold = 0;    ///< see decide()
  double alpha = 0.02;     ///< see decide()
  std::uint64_t seed = 1;  ///< seed of the random order of the two functions in each round
};

struct Trial {
  Difference difference;
  Decision decision;
};

/// Times `a` and `b`, and tests whether their times differ. In each round, each of the two functions makes
/// and times one pipeline. The order of the two functions is random. A pipeline corresponds to one process of
/// `pelage run --repeat`. `now_s` returns the current time in seconds.
Trial run_trial(const TimePipeline& a, const TimePipeline& b, const TrialLimits& limits,
                std::mt19937_64& random, const std::function<double()>& now_s);

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
