// A topology's tops on the device against the double-precision reference of the same scheme.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/compare/check.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Sticks that are compared; of prisms that share their tops all are.
inline constexpr std::size_t kCheckSticks = 6000;

/// `offsets` (R, one per stick) after `frames` frames: sticks and separable topologies within 1e-4 of the
/// fur's length everywhere; shared prisms, which buckle chaotically, within 1e-3 rms and 1e-2 in the 99th
/// percentile.
std::vector<Check> check_sticks(const FrameInput& input, int frames, const std::vector<glm::vec3>& offsets);

}  // namespace pelage
