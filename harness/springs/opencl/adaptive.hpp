// Advances a mass-spring system frame by frame with an adaptive number of steps per frame.
#pragma once
#include "harness/springs/opencl/mass_springs.hpp"

namespace pelage::springs {

/// Computes frames of equal length. Each frame is computed in n equal steps and again in 2 n steps from the
/// same state. If both results differ by more than the tolerance, or one diverges, n is doubled and the frame
/// is repeated. Otherwise the result of 2 n steps is kept. If the difference is below a quarter of the
/// tolerance, the next frame starts with n / 2, because a first-order scheme would still meet the tolerance.
/// A frame costs three times as much as n steps, plus transfers of the state to the host and back.
class AdaptiveSteps {
 public:
  /// span: length of a frame, s. steps: n of the first frame. tolerance: limit of the difference for 99 of
  /// 100 top masses, as a fraction of the fur's length. most: limit of 2 n. Throws InputError unless span and
  /// tolerance are above 0 and 1 <= steps <= most.
  AdaptiveSteps(float span, int steps, float tolerance, int most = 4096);

  struct Frame {
    int steps = 0;     ///< steps of the result that was kept
    double error = 0;  ///< difference from half as many steps, as a fraction of the fur's length
  };
  /// Computes the next frame. `masses` must be at rest or in the state after the previous frame of this
  /// object. Throws Diverged or InputError if `most` steps do not suffice.
  Frame advance(const cl::Queue& queue, MassSprings& masses, std::vector<cl::Event>* launches = nullptr);

 private:
  float span_, tolerance_;
  int steps_, most_;
  long frame_ = 0;
};

}  // namespace pelage::springs
