// Compares the top masses of a topology on the device with the double-precision reference of the same scheme.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/compare/check.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Approximate number of sticks that are compared. On shared prisms all sticks are compared.
inline constexpr std::size_t kCheckSticks = 6000;

/// Returns the checks of `offsets` (top mass minus base, R, one per stick) after `frames` frames. On sticks
/// and separable topologies the largest error must be within tolerance::stick_top of the fur's length. Shared
/// prisms are checked against tolerance::prisms_rms and tolerance::prisms_p99.
std::vector<Check> check_sticks(const FrameInput& input, int frames, const std::vector<glm::vec3>& offsets);

}  // namespace pelage
