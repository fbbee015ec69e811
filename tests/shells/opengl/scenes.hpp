// Draws scenes with the OpenGL baseline, for comparison with the reference.
#pragma once
#include <memory>
#include <string>

#include "harness/shells/opengl/opengl.hpp"
#include "tests/support/pictures.hpp"

namespace pelage::rival_tests {

using namespace pictures;

/// Returns the reference's wetness mask in the format that the constructor of OpenGl takes.
std::vector<glm::vec4> mask_of(const FrameInput& input);
/// Returns the reference's strand tips after `frames` frames, one per strand: tip minus root, in units of the
/// mesh radius R.
std::vector<glm::vec3> tips_of(const FrameInput& input);

/// Draws the frame with the OpenGL baseline. opengl_options() parses the text `options`.
Picture drawn_by_opengl(const std::shared_ptr<const FrameInput>& input, const std::string& options = "");

}  // namespace pelage::rival_tests
