// Compares the top masses of a topology on the device with the double-precision reference, which uses the
// same integration scheme.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/compare/check.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Approximate number of sticks that are compared. On shared prisms (adjacent prisms share their sticks) all
/// sticks are compared.
inline constexpr std::size_t kCheckSticks = 6000;

/// Returns the checks of `offsets` (top mass minus base in R, one per stick) after `frames` frames. Errors
/// are fractions of the fur's length. On shared prisms (adjacent prisms share their sticks), the rms error is
/// checked against tolerance::prisms_rms and the 99th percentile against tolerance::prisms_p99. On all other
/// topologies, the largest error is checked against tolerance::stick_top.
std::vector<Check> check_sticks(const FrameInput& input, int frames, const std::vector<glm::vec3>& offsets);

}  // namespace pelage
