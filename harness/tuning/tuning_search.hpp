// Searches for the fastest values of the tuning axes on a device. Candidates run alternately, and a candidate
// with wrong output cannot win.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "harness/measure/statistics.hpp"
#include "harness/tuning/tuning.hpp"

namespace pelage {

/// A configuration of the kernels that runs on one scene.
class Contender {
 public:
  virtual ~Contender() = default;
  virtual double run_ms() = 0;              ///< runs the work once more and returns its time in ms
  virtual std::uint64_t output_hash() = 0;  ///< hash of the last run's output
  virtual std::string kernel_hash() const { return {}; }  ///< hash of the OpenCL programs
  /// Compares the last output with the reference. Returns the fault in one line, or an empty string if the
  /// output is correct.
  virtual std::string fault() = 0;
};

/// A scene on which configurations are timed.
struct TuningScene {
  std::string name;
  /// Prepares a configuration for timing. It throws if the device cannot run the configuration. The search
  /// then stores the message of the exception in Candidate::fault.
  std::function<std::unique_ptr<Contender>(const Tuning&)> make;
};

/// A configuration of the kernels and the result of its timing.
struct Candidate {
  Tuning tuning;
  /// Time of this configuration divided by the time of the incumbent (the best configuration so far). In
  /// each round, the quotients of the scenes are combined by their geometric mean. The ratio is the median of
  /// the rounds' means.
  double ratio = 0;
  Interval interval;  ///< 95% confidence interval of the ratio, computed from the rounds
  /// Reason why the candidate cannot win: a failed check, or an error of the run. Empty if there is no fault.
  std::string fault;
  bool wins = false;  ///< whether `fault` is empty and the upper bound of `interval` is below 1
};

struct TuningSearch {
  Tuning best;  ///< fastest values with correct output; empty if the shipped values are fastest
  std::vector<Candidate> tried;  ///< all candidates in the order in which they were tried
  /// Final comparison of the best configuration with the shipped configuration. `last.tuning` is empty if no
  /// candidate won.
  Candidate last;
  std::string fault;  ///< fault of the shipped configuration; if it is not empty, the search did not run
};

/// Searches one axis after the other, in at most two passes over all axes. The incumbent is the best
/// configuration so far; at first it is the shipped configuration. For each axis, the candidates are the
/// configurations that differ from the incumbent in this axis only. The incumbent and the candidates run
/// alternately on each scene, for `rounds` rounds. Candidate::ratio is the time of a candidate divided by
/// the time of the incumbent. A candidate wins if its output is correct and the upper bound of the 95%
/// interval of this ratio is below 1. The fastest winner becomes the incumbent. One of many candidates may
/// win by chance. Therefore the last incumbent is compared with the shipped configuration once more, with
/// twice the rounds, and is dropped unless it wins again.
///
/// The output of the shipped configuration is compared with the reference. If the last output of a candidate
/// is bit-identical to an output that passed this comparison, the output is correct. Any other output is
/// compared with the reference. `told` is called with each candidate after its timing.
TuningSearch search_tuning(const std::vector<TuningAxis>& axes, const std::vector<TuningScene>& scenes,
                           int rounds, const std::function<void(const Candidate&)>& told);

}  // namespace pelage
