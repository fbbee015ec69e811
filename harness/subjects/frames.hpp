// The frames of a backend (harness/system/system.hpp) as a subject.
#pragma once
#include "harness/base/median.hpp"
#include "harness/measure/subject.hpp"
#include "harness/system/system.hpp"

namespace pelage {

/// Collects the times of the phase `simulate` of the frames of a case.
class SimulationTimes {
 public:
  void add(const FrameSample& sample) {
    const auto found = sample.phase_event_ms.find("simulate");
    if (found != sample.phase_event_ms.end()) ms_.push_back(found->second);
  }

  /// Adds the metric `simulate_ns_per_segment`: the median time per simulated segment, the part of a hair
  /// between two simulated points.
  void describe(Row& row, std::size_t segments) const {
    if (ms_.empty() || segments == 0) return;
    row.metrics["simulate_ns_per_segment"] = {1e6 * median(ms_) / double(segments), "ns"};
  }

 private:
  std::vector<double> ms_;
};

/// A subject that draws the case's scene with one backend. Its check() compares a timed picture with the
/// reference. Throws Unsupported if the backend cannot draw the scene on this machine.
class Frames : public Subject {
 public:
  /// If `still` is true, the fur does not move during the timed frames.
  Frames(SubjectContext& context, const Case& which, const KnownBackend& known, bool still = false);

  FrameSample frame() override;
  Picture read() override;
  std::vector<Check> check(const Picture& timed) override;
  void describe(Row& row) override;
  Backend& backend() { return *backend_; }

 private:
  std::unique_ptr<Backend> backend_;
  Scene scene_;
  std::shared_ptr<const Mesh> mesh_;
  bool still_;
  std::uint32_t seed_;
  std::uint64_t peak_ = 0;  ///< peak memory before the check, bytes
  SimulationTimes simulated_;
};

}  // namespace pelage
