// Searches for the fastest values of the tuning axes on a device. Contenders made from the stages of a frame
// run alternately. A contender with wrong output cannot win.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "harness/cl/device.hpp"
#include "harness/measure/statistics.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/tuning/tuning.hpp"

namespace pelage {

/// A configuration of the kernels that runs on one scene.
class Contender {
 public:
  virtual ~Contender() = default;
  virtual double run_ms() = 0;              ///< runs the work once more and returns its time in ms
  virtual std::uint64_t output_hash() = 0;  ///< hash of the last run's output
  virtual std::string kernel_hash() const { return {}; }  ///< hash of the OpenCL programs
  /// Compares the last output with the reference. Returns the fault in one line, or "" if it is correct.
  virtual std::string fault() = 0;
};

/// A scene on which configurations are timed.
struct TuningScene {
  std::string name;
  /// Prepares a configuration for timing. The message of an exception becomes Candidate::fault.
  std::function<std::unique_ptr<Contender>(const Tuning&)> make;
};

/// A configuration of the kernels and the result of its timing.
struct Candidate {
  Tuning tuning;
  /// Time of this configuration divided by that of the incumbent (the best configuration so far): the median
  /// over the rounds of the geometric mean over the scenes.
  double ratio = 0;
  Interval interval;  ///< 95% confidence interval of the ratio, computed from the rounds
  /// Reason why the candidate cannot win: a failed check, or an error of the run.
  std::string fault;
  bool wins = false;  ///< whether `fault` is empty and the upper bound of `interval` is below 1
};

struct TuningSearch {
  Tuning best;  ///< fastest values that give correct output; empty if the shipped values are fastest
  std::vector<Candidate> tried;  ///< all candidates in the order in which they were tried
  /// The last incumbent, timed once more against the shipped configuration. No tuning if no candidate won.
  Candidate last;
  std::string fault;  ///< fault of the shipped configuration; if it is not empty, the search did not run
};

/// Searches one axis after the other, in at most two passes over all axes. The incumbent is the best
/// configuration so far; at first it is the shipped configuration. For each axis, the candidates are the
/// configurations that differ from the incumbent in this axis only. The incumbent and the candidates run
/// alternately on each scene, for `rounds` rounds. A candidate wins if its output is correct and the upper
/// bound of the 95% interval of its ratio is below 1. The fastest winner becomes the incumbent. One of many
/// candidates may win by chance. Therefore the search compares the last incumbent with the shipped
/// configuration once more, with twice the rounds, and returns the shipped configuration if it does not win.
///
/// The output of a candidate is correct if it is bit-identical to an output that passed the comparison with
/// the reference (Contender::fault()), or if it passes this comparison. The search calls `told` with each
/// timed candidate.
TuningSearch search_tuning(const std::vector<TuningAxis>& axes, const std::vector<TuningScene>& scenes,
                           int rounds, const std::function<void(const Candidate&)>& told);

/// Returns a tuning scene called `name`, whose contenders run on `device`. For the stage "rasterize", a
/// contender times whole frames, for "simulate" the strand simulation of a frame, and for "wet" the
/// computation of the wetness mask. Throws InputError for other stages.
TuningScene tuning_scene(const std::string& stage, const std::string& name, const cl::Device& device,
                         const std::shared_ptr<const FrameInput>& input);

}  // namespace pelage
