// How the rival draws the scenes on which it is held against the reference.
#pragma once
#include <memory>
#include <string>

#include "harness/shells/opengl/opengl.hpp"
#include "tests/support/pictures.hpp"

namespace pelage::rival_tests {

using namespace pictures;

/// The reference's mask and tips after `frames` in the rival's types.
std::vector<glm::vec4> mask_of(const FrameInput& input);
std::vector<glm::vec3> tips_of(const FrameInput& input);

/// Options as in opengl_options().
Picture drawn_by_opengl(const std::shared_ptr<const FrameInput>& input, const std::string& options = "");

}  // namespace pelage::rival_tests
