// Times one case: warms up, then draws frames until the median is precise enough.
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "harness/experiment/experiment.hpp"
#include "harness/journal/row.hpp"

namespace pelage {

/// Times of one frame, ms. Event times are absent if the device's timer does not measure real time.
struct FrameSample {
  double wall_ms = 0;
  std::map<std::string, double> phase_event_ms = {};
  /// Wall times of other work in this round, such as the frame of a baseline.
  std::map<std::string, double> phase_wall_ms = {};
  /// CPU time of this process (harness/measure/cpu_use.hpp) during the same work as in wall_ms and
  /// phase_wall_ms, if the subject measures it.
  std::optional<double> cpu_ms = {};
  std::map<std::string, double> phase_cpu_ms = {};
};

struct Sampling {
  double first_launch_ms = 0;  ///< the first frame; drivers compile and upload during it
  /// The entry "frame" holds wall and CPU times. The entry of each phase holds its event times.
  std::map<std::string, PhaseSamples> samples;
  bool converged = false;  ///< whether the requested precision was reached
};

/// Times frames by calling `frame` until `limits` are met. `seconds` is a monotonic clock, s; tests pass
/// their own clock.
Sampling take_samples(const std::function<FrameSample()>& frame, const SamplingLimits& limits,
                      const std::function<double()>& seconds);
Sampling take_samples(const std::function<FrameSample()>& frame, const SamplingLimits& limits);

}  // namespace pelage
