// Checks of a frame of strands against the double-precision reference: a time step of the chains, the curves
// of the strands, the list of strands to draw, and the picture.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "harness/compare/metrics.hpp"
#include "harness/record/check.hpp"
#include "harness/strands/scene/strand_input.hpp"

namespace pelage {

/// What a device computed for a picture of strands.
struct StrandFrame {
  std::vector<strands::KeyStrand> keys;
  std::vector<strands::DrawnStrand> curves;  ///< all strands
  std::vector<strands::Entry> order;         ///< the strands in the picture, from front to back
  Picture picture;
  std::shared_ptr<const strands::SkinSurface> skin = {};  ///< the skin in the picture, or null
};

/// A time step of the chains on a device: their states before and after it. `number` is the index of the
/// step.
struct ChainStep {
  std::vector<strands::ChainState> before, after;
  long number = 0;
  /// If the mesh deforms: the skin in two frames. The step ends in the middle between them.
  std::optional<std::pair<strands::SkinFrame, strands::SkinFrame>> skin = {};
};

/// Compares the time step of about 2,000 chains, chosen by `seed`, with the reference. The checks are the
/// shares of chains whose directions and rates are within tolerance::chain_direction and
/// tolerance::chain_rate.
std::vector<Check> check_chain_step(const strands::StrandInput& input, const ChainStep& step,
                                    std::uint32_t seed);

struct StrandCheck {
  std::vector<Check> checks;
  Agreement agreement;          ///< of the pictures
  std::uint64_t fragments = 0;  ///< number of fragments of the reference's picture with a coverage above 0
};

/// Compares the frame with the reference: the curves with those that the reference computes from the frame's
/// key strands, for about 20,000 strands chosen by `seed`; the order, which must be the same; and the whole
/// picture.
StrandCheck check_strand_frame(const strands::StrandInput& input, const StrandFrame& frame,
                               std::uint32_t seed);

/// Computes the curves of all strands with the reference, from the key strands `keys`.
std::vector<strands::DrawnStrand> reference_curves(const strands::StrandInput& input,
                                                   const std::vector<strands::KeyStrand>& keys);

/// Computes the picture with the reference alone, from the key strands `keys` and the skin, which may be
/// null.
StrandFrame reference_strands(const strands::StrandInput& input, const std::vector<strands::KeyStrand>& keys,
                              std::shared_ptr<const strands::SkinSurface> skin);

/// Simulates `frames` frames from rest with the reference alone. Returns the key strands, and the skin of the
/// last frame or null. Calls `each` with the key strands after each frame.
std::pair<std::vector<strands::KeyStrand>, std::shared_ptr<const strands::SkinSurface>> reference_keys(
    const strands::StrandInput& input, int frames,
    const std::function<void(const std::vector<strands::KeyStrand>&)>& each = {});

/// Computes the picture after `frames` frames from rest with the reference alone. Uses all cores; a frame of
/// 70,000 key strands takes about 0.1 s.
StrandFrame reference_strands(const strands::StrandInput& input, int frames);

}  // namespace pelage
