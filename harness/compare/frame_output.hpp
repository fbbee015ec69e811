// What a pipeline computed of a frame, and the same by the double-precision reference.
#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

struct FrameOutput {
  std::string
      pipeline;    ///< "shells on DEVICE", "opengl on RENDERER, OPTIONS", "reference" or "reference, 8 bits"
  int frames = 0;  ///< frames of strand motion since rest, this one included
  std::vector<glm::vec3> tips;        ///< F, p minus root, R; of a topology one per stick, top minus base
  std::vector<glm::vec3> velocities;  ///< of the tips, R/s
  std::vector<glm::vec4> mask;        ///< wetness.size^2: c_u, c_v, r, rho
  Picture image;
};

/// Tips, velocities and mask by the double-precision reference; no image. Throws InputError where the scene's
/// topology takes steps of its own choice (dynamics.tolerance above 0).
FrameOutput reference_motion(const FrameInput& input, int frames);

/// The same with the image. `eight_bit`: the picture is rounded to 8 bits after every layer.
FrameOutput reference_output(const FrameInput& input, int frames, bool eight_bit);

}  // namespace pelage
