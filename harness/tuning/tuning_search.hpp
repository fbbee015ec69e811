// Searches the best tuning for a device. Candidates run in turns, and a candidate with wrong output cannot
// win.
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
  virtual double run_ms() = 0;              ///< runs the work once more and returns its time, ms
  virtual std::uint64_t output_hash() = 0;  ///< hash of the last run's output
  virtual std::string kernel_hash() const { return {}; }  ///< hash of its programs
  /// Compares the last output with the reference. Returns the fault in one line; empty if there is none.
  virtual std::string fault() = 0;
};

/// A scene on which configurations are timed. If `make` throws, the device cannot run the configuration, and
/// the configuration has a fault.
struct TuningScene {
  std::string name;
  std::function<std::unique_ptr<Contender>(const Tuning&)> make;
};

/// A configuration and its result.
struct Candidate {
  Tuning tuning;
  /// Its time divided by the incumbent's time: geometric mean over scenes, then median over rounds.
  double ratio = 0;
  Interval interval;  ///< 95% interval of the ratio over rounds
  /// Why it cannot win: a failed check, or an error of the run. Empty if there is no fault.
  std::string fault;
  bool wins = false;  ///< without fault, and the whole interval is below 1
};

struct TuningSearch {
  Tuning best;                   ///< faster than the shipped values, without fault; empty if there are none
  std::vector<Candidate> tried;  ///< all candidates in the order in which they were tried
  /// The best configuration compared with the shipped one. Its tuning is empty if no candidate won.
  Candidate last;
  std::string fault;  ///< fault of the shipped configuration; if set, nothing was searched
};

/// Searches one axis after the other, in at most two passes. For each axis the incumbent and all other values
/// run in turns for `rounds` rounds on each scene. The first incumbent is the shipped configuration. The
/// fastest candidate that wins becomes the incumbent. One of many candidates may win by chance. Therefore, in
/// the end the incumbent is compared with the shipped configuration once more, with twice the rounds, and is
/// dropped unless it wins again.
///
/// The shipped configuration is checked against the reference. A candidate whose last output equals a checked
/// output bit for bit has no fault; any other output is checked against the reference. `told` is called with
/// each candidate.
TuningSearch search_tuning(const std::vector<TuningAxis>& axes, const std::vector<TuningScene>& scenes,
                           int rounds, const std::function<void(const Candidate&)>& told);

}  // namespace pelage
