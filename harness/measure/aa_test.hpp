// Trials of the statistical test behind pelage compare, with real timings whose true difference is known.
#pragma once
#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "harness/measure/difference.hpp"

namespace pelage {

/// Makes a new pipeline with new buffers, and returns wall times of its warm frames in ms.
using TimePipeline = std::function<std::vector<double>()>;

struct TrialLimits {
  int rounds = 12;         ///< number of pipelines per side; at least fewest_processes
  double threshold = 0;    ///< see decide()
  double alpha = 0.02;     ///< see decide()
  std::uint64_t seed = 1;  ///< of the order of the sides
};

struct Trial {
  Difference difference;
  Decision decision;
};

/// Compares the side `b` with the side `a`. In each round, both sides make and time one pipeline, in a random
/// order. The pipelines take the place of the separate processes of `pelage run --repeat`. `now_s` returns
/// the time in seconds.
Trial run_trial(const TimePipeline& a, const TimePipeline& b, const TrialLimits& limits,
                std::mt19937_64& random, const std::function<double()>& now_s);

/// Numbers of trials by their decision.
struct TrialCounts {
  int faster = 0, slower = 0, same = 0, undecided = 0;
  int all() const { return faster + slower + same + undecided; }
};
TrialCounts count_of(std::span<const Trial> trials);

/// Returns the 95% interval of a probability (Clopper and Pearson) after `hits` of `all` trials.
Interval rate_interval(int hits, int all);

/// Returns the header and one line per trial as CSV. `side` is the text of the first column.
std::string trials_csv_header();
std::string trials_csv(const std::string& side, std::span<const Trial> trials);

}  // namespace pelage
