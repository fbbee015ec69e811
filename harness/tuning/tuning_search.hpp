// The search for a device's best tuning: candidates take turns, and none wins that draws something else.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "harness/measure/statistics.hpp"
#include "harness/tuning/tuning.hpp"

namespace pelage {

/// A configuration at work on one scene.
class Contender {
 public:
  virtual ~Contender() = default;
  virtual double run_ms() = 0;                            ///< the work once more, ms
  virtual std::uint64_t output_hash() = 0;                ///< of what the last run computed
  virtual std::string kernel_hash() const { return {}; }  ///< of the programs that it runs
  virtual std::string fault() = 0;  ///< what the reference says against it, in one line; "" for nothing
};

/// A scene to be timed on. `make` may throw: a configuration that the device cannot run is no candidate.
struct TuningScene {
  std::string name;
  std::function<std::unique_ptr<Contender>(const Tuning&)> make;
};

/// A configuration and what came of it.
struct Candidate {
  Tuning tuning;
  double ratio = 0;   ///< median over rounds of its time by the incumbent's, geometric mean over scenes
  Interval interval;  ///< 95%, over rounds
  std::string fault;  ///< why it cannot win: what the check says, or why it does not run; "" for nothing
  bool wins = false;  ///< faultless, and its whole interval lies below 1
};

struct TuningSearch {
  Tuning best;                   ///< faultless, and not slower than what is shipped in the last duel
  std::vector<Candidate> tried;  ///< in their order
  Candidate last;                ///< the winner of the axes against what is shipped; empty tuning: none won
  std::string fault;             ///< the shipped configuration's own; then nothing was searched
};

/// Axis by axis, twice at most: the incumbent (first: what is shipped) and every value of the axis take turns
/// for `rounds` rounds on each scene; the best that wins becomes the incumbent. In the end the incumbent
/// meets what is shipped once more, for twice the rounds, and is dropped unless it wins again: of many
/// candidates one may win by chance.
///
/// A candidate whose last output equals the shipped configuration's, bit for bit, is faultless; another asks
/// the reference. The shipped configuration asks it always. `told` hears of each candidate.
TuningSearch search_tuning(const std::vector<TuningAxis>& axes, const std::vector<TuningScene>& scenes,
                           int rounds, const std::function<void(const Candidate&)>& told);

}  // namespace pelage
