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
  double wall_ms = 0;
  std::map<std::string, double> phase_event_ms = {};
  /// Wall times of other work that is timed together with this frame, for example of a frame of a baseline.
  /// The key is the name of the work.
  std::map<std::string, double> phase_wall_ms = {};
  /// CPU times of this process (harness/measure/cpu_use.hpp) during the intervals that wall_ms and
  /// phase_wall_ms measure. They are absent if the subject does not measure them.
  std::optional<double> cpu_ms = {};
  std::map<std::string, double> phase_cpu_ms = {};
};

struct Sampling {
  double first_launch_ms = 0;  ///< time of the first frame, which includes compilation and uploads
  /// The entry "frame" holds the times of whole frames. Each phase has an entry with the times of that phase.
  std::map<std::string, PhaseSamples> samples;
  bool converged = false;  ///< whether the median reached the precision that the SamplingLimits require
};

/// Times frames by calling `frame` until the median has the precision that `limits` requires, or until
/// another limit of `limits` is reached. `seconds` returns the time of a monotonic clock in seconds; tests
/// pass a simulated clock.
Sampling take_samples(const std::function<FrameSample()>& frame, const SamplingLimits& limits,
                      const std::function<double()>& seconds);
Sampling take_samples(const std::function<FrameSample()>& frame, const SamplingLimits& limits);

}  // namespace pelage
