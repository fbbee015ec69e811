// A topology's tops on the device against the double-precision reference of the same scheme.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/compare/check.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Sticks that are compared; of prisms that share their tops all are.
inline constexpr std::size_t kCheckSticks = 6000;

/// `offsets` (R, one per stick) after `frames` frames: sticks and separable topologies everywhere within
/// tolerance::stick_top of the fur's length; shared prisms within tolerance::prisms_rms and
/// tolerance::prisms_p99.
std::vector<Check> check_sticks(const FrameInput& input, int frames, const std::vector<glm::vec3>& offsets);

}  // namespace pelage
