// Times one case: warms up, then times frames until the median is precise enough or a limit is reached.
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "harness/experiment/experiment.hpp"
#include "harness/record/row.hpp"

namespace pelage {

/// Times of one frame in ms. Event times are absent if the device's timer does not measure real time.
struct FrameSample {
  double wall_ms;
  std::map<std::string, double> phase_event_ms = {};
  /// Name -> wall time of other work that is timed together with this frame, for example a frame of a
  /// baseline.
  std::map<std::string, double> phase_wall_ms = {};
  /// CPU times of this process during the intervals of wall_ms and phase_wall_ms, if the subject measures
  /// them.
  std::optional<double> cpu_ms = {};
  std::map<std::string, double> phase_cpu_ms = {};
};

struct Sampling {
  double first_launch_ms;  ///< time of the first frame, which includes compilation and uploads
  /// Phase -> times; "frame" is the whole frame.
  std::map<std::string, PhaseSamples> samples;
  bool converged;  ///< whether the median reached the precision that the SamplingLimits require
};

/// Times frames by calling `frame` until the median has the precision that `limits` requires, or until
/// another limit is reached. `seconds` is a monotonic clock; tests pass a simulated one.
Sampling take_samples(const std::function<FrameSample()>& frame, const SamplingLimits& limits,
                      const std::function<double()>& seconds);
Sampling take_samples(const std::function<FrameSample()>& frame, const SamplingLimits& limits);

/// Returns the reason why the event times of timed frames are implausible, or "". Some drivers return times
/// that are unrelated to the duration of the kernels. harness/cl/timer.hpp has another test. Event times are
/// implausible if
/// - some frames have none,
/// - their median is above the median wall time (plus 10% for the drift between the clocks),
/// - their median is below 0.01% of the median wall time, or
/// - they are equal in six or more frames whose wall times differ.
std::string implausible_events(const std::map<std::string, PhaseSamples>& samples);

/// Removes implausible event times of the row, and phases that then have no times, and writes the reason into
/// the entry "event_times" of the provenance.
void remove_implausible_events(Row& row);

}  // namespace pelage
