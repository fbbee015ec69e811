// Draws, with the OpenGL baseline, the scenes that are compared with the reference.
#pragma once
#include <memory>
#include <string>

#include "harness/shells/opengl/opengl.hpp"
#include "tests/support/pictures.hpp"

namespace pelage::rival_tests {

using namespace pictures;

/// Return the reference's mask, and its tips after `frames` frames, in the types of OpenGl.
std::vector<glm::vec4> mask_of(const FrameInput& input);
std::vector<glm::vec3> tips_of(const FrameInput& input);

/// `options` is text for opengl_options().
Picture drawn_by_opengl(const std::shared_ptr<const FrameInput>& input, const std::string& options = "");

}  // namespace pelage::rival_tests
