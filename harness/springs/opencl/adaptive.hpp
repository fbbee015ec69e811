// Advances a mass-spring system frame by frame with an adaptive number of steps per frame.
#pragma once
#include "harness/springs/opencl/mass_springs.hpp"

namespace pelage::springs {

/// Computes frames of equal duration, each in n equal steps and, from the same state, again in 2 * n steps.
/// If the results differ by more than the tolerance, or if one of them diverges, n is doubled and the frame
/// is repeated. Otherwise the result of 2 * n steps is kept. If the difference is less than a quarter of the
/// tolerance, the next frame starts with n / 2, because the doubled error of a first-order scheme still meets
/// the tolerance. A frame without repetition takes three times as long as n steps, plus transfers of the
/// state to the host and back.
class AdaptiveSteps {
 public:
  /// `span` is the duration of a frame in seconds. `steps` is the value of n for the first frame. `tolerance`
  /// is the greatest difference between the results of n and of 2 * n steps: the 99th percentile of the
  /// distances of the tops, as a fraction of the fur's length. `most` is the largest value of 2 * n. Throws
  /// InputError unless `span` and `tolerance` are above 0 and 1 <= steps <= most.
  AdaptiveSteps(float span, int steps, float tolerance, int most = 4096);

  struct Frame {
    int steps = 0;     ///< number of steps of the kept result
    double error = 0;  ///< its difference from the result of half as many steps
  };
  /// Computes the next frame. `masses` must be at rest (first call) or in the state that the previous call
  /// left. Throws Diverged or InputError if `most` steps do not suffice.
  Frame advance(const cl::Queue& queue, MassSprings& masses, std::vector<cl::Event>* launches = nullptr);

 private:
  float span_, tolerance_;
  int steps_, most_;
  long frame_ = 0;
};

}  // namespace pelage::springs
