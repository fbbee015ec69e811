// Frames of a mass-spring system in as many steps as they need.
#pragma once
#include "harness/springs/opencl/mass_springs.hpp"

namespace pelage::springs {

/// Takes frames of equal length, each in n equal steps and again in 2 n from the same state; where the two
/// differ by more than the tolerance n is doubled, until they do not, and the finer one is kept. The next
/// frame begins with half as many once the difference is below a quarter of the tolerance: what a scheme of
/// first order would still keep. An explosion is a difference, too. Costs three times what n steps do, and
/// the state's way to the host and back.
class AdaptiveSteps {
 public:
  /// span: of a frame, s; steps: of the first one; tolerance: of the fur's length, asked of 99 tops in 100;
  /// most: steps of a frame. Throws InputError unless span and tolerance are above 0 and 1 <= steps <= most.
  AdaptiveSteps(float span, int steps, float tolerance, int most = 4096);

  struct Frame {
    int steps = 0;     ///< that were kept
    double error = 0;  ///< the difference from half as many, of the fur's length
  };
  /// One frame further, from where `masses` are, at rest or after frames of this object. Throws Diverged or
  /// InputError where `most` steps are too few.
  Frame advance(const cl::Queue& queue, MassSprings& masses, std::vector<cl::Event>* launches = nullptr);

 private:
  float span_, tolerance_;
  int steps_, most_;
  long frame_ = 0;
};

}  // namespace pelage::springs
