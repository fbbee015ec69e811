// The scenes on which a pipeline's picture is held against the reference's, and how the reference draws them.
#pragma once
#include <memory>
#include <string>

#include "harness/compare/metrics.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/shells/reference/reference.hpp"

namespace pelage::pictures {

/// Curly, wet and windy fur on a named model, 320 x 200: what Table 1 times, at a test's size.
std::shared_ptr<const FrameInput> model_frame(const std::string& model, int layers,
                                              const std::string& shading);

/// A torus made of formulas, 160 x 100, with combed, curly, wet and windy fur: small enough for many
/// pictures.
std::shared_ptr<const FrameInput> small_frame(const std::string& shading,
                                              const std::string& binding = "shared", int layers = 16);

/// Frames of motion before a picture is compared: the gust has bent the fur.
constexpr int frames = 16;

Picture drawn_by_reference(const FrameInput& input, reference::Mutant mutant = reference::Mutant::none,
                           bool eight_bit = false);

/// "74.3 dB, 74.9 dB without 1 flips, 99.9% within 0.0002, worst 0.03 at (143, 26), 25378 fur pixels": for a
/// failed test's message.
std::string describe(const Agreement& agreement);

}  // namespace pelage::pictures
