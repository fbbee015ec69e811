// Advances a mass-spring system frame by frame with an adaptive number of steps per frame.
#pragma once
#include "harness/springs/opencl/mass_springs.hpp"

namespace pelage::springs {

/// Computes frames of equal duration. Each frame is computed in n equal steps and, from the same state, again
/// in 2 * n steps. If the difference between the two results is greater than the tolerance, or if one of them
/// diverges, n is doubled and the frame is repeated. Otherwise the result of 2 * n steps is kept. If the
/// difference is less than a quarter of the tolerance, the next frame starts with n / 2. Halving n doubles
/// the error of a first-order scheme, and the doubled error still meets the tolerance. A frame without
/// repetition takes three times as long as n steps, plus transfers of the state to the host and back.
class AdaptiveSteps {
 public:
  /// `span` is the duration of a frame in seconds. `steps` is the value of n for the first frame. `tolerance`
  /// is the greatest allowed difference between the results of n and of 2 * n steps. To compute the
  /// difference, the class takes the distance between the two positions of each top mass: after n steps
  /// and after 2 * n steps. The difference is the 99th percentile of these distances, as a fraction of the
  /// fur's length. `most` is the largest value of 2 * n. Throws InputError unless `span` and `tolerance` are
  /// above 0 and 1 <= steps <= most.
  AdaptiveSteps(float span, int steps, float tolerance, int most = 4096);

  struct Frame {
    int steps = 0;  ///< number of steps of the kept result
    /// Difference (99th percentile, in fur lengths) between the positions after `steps` steps and the
    /// positions after half as many steps of twice the length.
    double error = 0;
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
