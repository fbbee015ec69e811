// The scenes on which a pipeline's picture is compared with the reference, and the reference's picture of
// them.
#pragma once
#include <memory>
#include <string>

#include "harness/compare/metrics.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/shells/reference/reference.hpp"

namespace pelage::pictures {

/// Curly, wet and windy fur on a named model, 320 x 200 pixels: a smaller form of the scenes of Table 1.
std::shared_ptr<const FrameInput> model_frame(const std::string& model, int layers,
                                              const std::string& shading);

/// A torus computed by formulas, 160 x 100 pixels, with combed, curly, wet and windy fur. It is small enough
/// for many pictures.
std::shared_ptr<const FrameInput> small_frame(const std::string& shading,
                                              const std::string& binding = "shared", int layers = 16);

/// Number of frames of motion before pictures are compared. The gust has then bent the fur.
constexpr int frames = 16;

Picture drawn_by_reference(const FrameInput& input, reference::Mutant mutant = reference::Mutant::none,
                           bool eight_bit = false);

/// Returns text for the message of a failed test, such as "74.3 dB, 74.9 dB without 1 flips, 99.9% within
/// 0.0002, worst 0.03 at (143, 26), 25378 fur pixels".
std::string describe(const Agreement& agreement);

}  // namespace pelage::pictures
