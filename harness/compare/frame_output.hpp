// The results of a pipeline for one frame, and the same results of the double-precision reference.
#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

struct FrameOutput {
  /// One of "shells on DEVICE", "opengl on RENDERER, OPTIONS", "reference" and "reference, 8 bits".
  std::string pipeline;
  int frames = 0;  ///< frames of strand motion since rest, including this one
  /// Per triangle, the strand's tip minus its root, R. With a mass-spring topology: per stick, its top minus
  /// its base.
  std::vector<glm::vec3> tips;
  std::vector<glm::vec3> velocities;  ///< velocities of the tips, R/s
  std::vector<glm::vec4> mask;        ///< wetness.size^2 texels (c_u, c_v, r, rho)
  Picture image;
};

/// Computes tips, velocities and mask by the double-precision reference; the image stays empty. Throws
/// InputError if the scene selects adaptive time steps (dynamics.tolerance above 0).
FrameOutput reference_motion(const FrameInput& input, int frames);

/// Computes the same and the image. If `eight_bit` is set, the picture is rounded to 8 bits after every
/// layer.
FrameOutput reference_output(const FrameInput& input, int frames, bool eight_bit);

}  // namespace pelage
