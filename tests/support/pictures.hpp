// The scenes on which tests compare the picture of a pipeline with the reference, and the reference's
// pictures of these scenes.
#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "harness/compare/metrics.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/shells/reference/reference.hpp"

namespace pelage::pictures {

/// Returns the input of a frame of `width` x 5/8 `width` pixels: a named model with curly, wet fur in the
/// wind, as in Table 1 of Curling and Clumping Fur (Silva et al. 2010) but smaller.
std::shared_ptr<const FrameInput> model_frame(const std::string& model, int layers,
                                              const std::string& shading, int width = 320);

/// Returns the input of a frame of 160 x 100 pixels: a torus with combed, curly, wet fur in the wind. The
/// torus is computed by formulas. It is small enough for tests of many pictures.
std::shared_ptr<const FrameInput> small_frame(const std::string& shading,
                                              const std::string& binding = "shared", int layers = 16);

/// Number of frames of motion before pictures are compared. After these frames a gust has bent the fur.
constexpr int frames = 16;

Picture drawn_by_reference(const FrameInput& input, reference::Mutant mutant = reference::Mutant::none,
                           bool eight_bit = false);

/// Mistakes in the light, the order and the clumps of fur, which every comparison with the reference must
/// see.
inline constexpr reference::Mutant planted[] = {
    reference::Mutant::layer_missing,      reference::Mutant::height_without_one,
    reference::Mutant::triangles_reversed, reference::Mutant::front_faces_culled,
    reference::Mutant::uv_swapped,         reference::Mutant::mask_bilinear,
    reference::Mutant::droplets_reversed,  reference::Mutant::log_negated};

bool same_bits(const Picture& a, const Picture& b);

/// Returns a summary for the message of a failed test. A pixel is flipped if it differs from the reference by
/// more than tolerance::flip (2/255) in some channel.
std::string describe(const Agreement& agreement);

/// Whether two pictures count as equal (within()), and have more than `least_pixels` fur pixels. The message
/// and the recorded property "agreement" describe the differences.
testing::AssertionResult same(const Picture& expected, const Picture& drawn, std::size_t least_pixels = 0);

/// Frames that every pipeline must draw like the reference, with their names. Except for the first list, they
/// are small_frame("wet") with other values of scene keys.
using Cases = std::vector<std::pair<std::string, FrameInput>>;
Cases models_and_bindings();
/// Where the papers are ambiguous, scene keys select an interpretation. These frames have values other than
/// the defaults.
Cases other_readings();
Cases clump_readings();  ///< clump.scale and shading.tangent
Cases soaked_fur();
Cases consistent_borders();
Cases orders_of_faces();
Cases other_sizes();
/// The camera is so near to a square that its triangles cross the near plane and the guard band.
Cases fur_behind_the_eye(int layers = 16);

/// Returns a furry square in the plane z = 0 with normals along +z. The eye is above the square if `side` is
/// 1, and below it if `side` is -1. One light shines from the eye's side. `sides` is shading.sides.
FrameInput square_seen_from(float side, const std::string& shading, const std::string& sides);

}  // namespace pelage::pictures
