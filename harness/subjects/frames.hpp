// The frames of a backend (harness/system/system.hpp) as a subject that the harness can time.
#pragma once
#include "harness/measure/subject.hpp"
#include "harness/subjects/simulation_times.hpp"
#include "harness/system/system.hpp"

namespace pelage {

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
