// The scenes on which the rival is held against the reference, and how it draws them.
#pragma once
#include <memory>
#include <string>

#include "harness/picture/metrics.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/reference/reference.hpp"
#include "harness/rivals/opengl.hpp"

namespace pelage::rival_tests {

/// Curly, wet and windy fur on a named model, 320 x 200.
std::shared_ptr<const FrameInput> model_frame(const std::string& model, int layers,
                                              const std::string& shading);

/// A torus made of formulas, 160 x 100, with combed, curly, wet and windy fur.
std::shared_ptr<const FrameInput> small_frame(const std::string& shading,
                                              const std::string& binding = "shared");

/// Frames of motion before a picture is compared: the gust has bent the fur.
constexpr int frames = 16;

/// The reference's mask and tips after `frames` in the rival's types.
std::vector<glm::vec4> mask_of(const FrameInput& input);
std::vector<glm::vec3> tips_of(const FrameInput& input);

/// Options as in opengl_options().
Picture drawn_by_opengl(const std::shared_ptr<const FrameInput>& input, const std::string& options = "");
Picture drawn_by_reference(const FrameInput& input, reference::Mutant mutant = reference::Mutant::none,
                           bool eight_bit = false);

/// "74.3 dB, 99.9% within 0.0002, worst 0.03 at (143, 26), 25378 pixels".
std::string describe(const Agreement& agreement);

}  // namespace pelage::rival_tests
