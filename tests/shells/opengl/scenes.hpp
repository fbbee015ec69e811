// Draws scenes with the OpenGL baseline, for comparison with the reference.
#pragma once
#include <memory>
#include <string>

#include "harness/compare/frame_output.hpp"
#include "harness/shells/opengl/opengl.hpp"
#include "tests/support/pictures.hpp"

namespace pelage::rival_tests {

using namespace pictures;

/// The reference's wetness mask, and its strand tips minus roots after `frames` frames.
inline std::vector<glm::vec4> mask_of(const FrameInput& input) {
  return reference_mask(input, frames);
}
inline std::vector<glm::vec3> tips_of(const FrameInput& input) {
  return reference_motion(input, frames).tips;
}

/// Draws the frame with the OpenGL baseline. opengl_options() parses the text `options`.
inline Picture drawn_by_opengl(const std::shared_ptr<const FrameInput>& input,
                               const std::string& options = "") {
  OpenGl opengl(input, mask_of(*input), opengl_options(options));
  opengl.bend(tips_of(*input), frames);
  opengl.frame();
  return opengl.read();
}

}  // namespace pelage::rival_tests
