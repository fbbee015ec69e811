// The results of a pipeline for one frame, and functions that compute them with the double-precision
// reference.
#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

struct FrameOutput {
  /// Name of the pipeline: "shells on DEVICE", "opengl on RENDERER, OPTIONS", "reference" or "reference, 8
  /// bits".
  std::string pipeline;
  int frames = 0;  ///< number of frames simulated from rest, including this frame
  /// Silva's strands: for each triangle, the position of its strand's tip minus the position of the strand's
  /// root. Mass-spring topologies: for each stick, the position of its top mass minus the position of its
  /// base. The unit is R.
  std::vector<glm::vec3> tips;
  std::vector<glm::vec3> velocities;  ///< velocities of the tips in R/s
  std::vector<glm::vec4> mask;        ///< mask texels: clump centre (c_u, c_v), clump radius, wetness
  Picture image;
};

/// Returns the reference's mask after `frames` frames, in the form of FrameOutput::mask.
std::vector<glm::vec4> reference_mask(const FrameInput& input, int frames);

/// Computes tips, velocities and mask with the double-precision reference. The image stays empty. Throws
/// InputError if the scene selects adaptive time steps (dynamics.tolerance above 0).
FrameOutput reference_motion(const FrameInput& input, int frames);

/// Computes the results of reference_motion() and, in addition, the image. If `eight_bit` is set, the image
/// is rounded to 8 bits after every layer.
FrameOutput reference_output(const FrameInput& input, int frames, bool eight_bit);

}  // namespace pelage
