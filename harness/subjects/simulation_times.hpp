// The time that the simulation of a hair takes.
#pragma once
#include <vector>

#include "harness/base/median.hpp"
#include "harness/measure/subject.hpp"
#include "harness/record/row.hpp"

namespace pelage {

/// Collects the times of the phase `simulate` of the frames of a case.
class SimulationTimes {
 public:
  void add(const FrameSample& sample) {
    const auto found = sample.phase_event_ms.find("simulate");
    if (found != sample.phase_event_ms.end()) ms_.push_back(found->second);
  }

  /// Adds the metric `simulate_ns_per_segment`: the median time divided by the number of simulated segments,
  /// a segment being the part of a hair between two simulated points.
  void describe(Row& row, std::size_t segments) const {
    if (ms_.empty() || segments == 0) return;
    row.metrics["simulate_ns_per_segment"] = {1e6 * median(ms_) / double(segments), "ns"};
  }

 private:
  std::vector<double> ms_;
};

}  // namespace pelage
