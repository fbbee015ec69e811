// Compares the device's positions of the top masses with the positions in the double-precision reference.
// Device and reference use the same integration scheme.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/record/check.hpp"

namespace pelage {

/// Approximate number of sticks that are compared. With the topology "prisms" (adjacent prisms share their
/// sticks), all sticks are compared.
inline constexpr std::size_t kCheckSticks = 6000;

/// Compares the device's sticks after `frames` frames with the reference's sticks, and returns the checks.
/// `offsets` contains the position of each stick's top mass minus the position of the stick's base, in units
/// of R (the mesh radius). Errors are fractions of the fur's length. With the topology "prisms" (adjacent
/// prisms share their sticks), the rms error must be at most tolerance::prisms_rms, and the 99th percentile
/// of the errors must be at most tolerance::prisms_p99. With all other topologies, the largest error must be
/// at most tolerance::stick_top.
std::vector<Check> check_sticks(const FrameInput& input, int frames, const std::vector<glm::vec3>& offsets);

}  // namespace pelage
