// Computes the motion of sticks with the double-precision solvers of reference.hpp. `pelage run` and
// `pelage check` compare the device's sticks with the result, and the reference renderer draws it.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::springs {

/// State of a selection of sticks after some frames that start from rest.
struct SomeSticks {
  std::vector<std::uint32_t> stick;  ///< indices of the sticks, ascending
  std::vector<glm::dvec3> offset;    ///< per stick: position of the top mass relative to the base, in R
  std::vector<glm::dvec3> velocity;  ///< per stick: velocity of the top mass in R/s, in the object's frame
};
/// Computes the state of about `count` sticks with evenly spaced indices, or of all sticks of the topology
/// prisms, in which each stick depends on all others.
SomeSticks some_reference_sticks(const FrameInput& input, int frames, std::size_t count);

}  // namespace pelage::springs
