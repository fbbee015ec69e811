// The scenes on which tests compare the picture of a pipeline with the reference, and the reference's
// pictures of these scenes.
#pragma once
#include <memory>
#include <string>

#include "harness/compare/metrics.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/shells/reference/reference.hpp"

namespace pelage::pictures {

/// Returns curly, wet and windy fur on a named model, 320 x 200 pixels. This is a smaller version of the
/// scenes of Table 1 in Curling and Clumping Fur (Silva et al. 2010).
std::shared_ptr<const FrameInput> model_frame(const std::string& model, int layers,
                                              const std::string& shading);

/// Returns a torus with combed, curly, wet and windy fur, 160 x 100 pixels. The torus is computed by
/// formulas. It is small enough for tests of many pictures.
std::shared_ptr<const FrameInput> small_frame(const std::string& shading,
                                              const std::string& binding = "shared", int layers = 16);

/// Number of frames of motion before pictures are compared. After these frames a gust has bent the fur.
constexpr int frames = 16;

Picture drawn_by_reference(const FrameInput& input, reference::Mutant mutant = reference::Mutant::none,
                           bool eight_bit = false);

/// Returns a summary for the message of a failed test: the PSNR, the PSNR without the flipped pixels (pixels
/// that differ by more than 2/255) and their number, the 99.9th percentile of the pixels' differences, the
/// largest difference and its pixel, and the number of fur pixels. A flip is a pixel that differs from the
/// reference by more than tolerance::flip in some channel.
std::string describe(const Agreement& agreement);

}  // namespace pelage::pictures
