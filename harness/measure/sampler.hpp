// How one case is timed: warm up, then frames until the median is known well enough.
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "harness/experiment/experiment.hpp"
#include "harness/journal/row.hpp"

namespace pelage {

/// What one frame cost, ms. Event times are absent where the device's timer is not real.
struct FrameSample {
  double wall_ms = 0;
  std::map<std::string, double> phase_event_ms = {};
  /// What else was timed in this round, such as a rival's frame.
  std::map<std::string, double> phase_wall_ms = {};
  /// CPU time of this process (harness/measure/cpu_use.hpp) over the same stretches as wall_ms and
  /// phase_wall_ms, where the subject takes it.
  std::optional<double> cpu_ms = {};
  std::map<std::string, double> phase_cpu_ms = {};
};

struct Sampling {
  double first_launch_ms = 0;  ///< the very first frame: drivers compile and upload in it
  std::map<std::string, PhaseSamples>
      samples;             ///< "frame" holds the wall and CPU times; each phase its event times
  bool converged = false;  ///< the precision was reached
};

/// Draws frames by `frame` as `limits` say. `seconds` is a monotonic clock, s (tests bring their own).
Sampling take_samples(const std::function<FrameSample()>& frame, const SamplingLimits& limits,
                      const std::function<double()>& seconds);
Sampling take_samples(const std::function<FrameSample()>& frame, const SamplingLimits& limits);

}  // namespace pelage
