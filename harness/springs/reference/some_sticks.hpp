// The motion of a topology's sticks in double precision. The device's sticks are compared with it, and
// pictures of the reference are drawn with it.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::springs {

/// Returns the position of each top mass relative to its base, R, `frames` frames after rest, as computed by
/// reference.hpp.
std::vector<glm::dvec3> reference_sticks(const FrameInput& input, int frames);

/// The state of some sticks, `frames` frames after rest.
struct SomeSticks {
  std::vector<std::uint32_t> stick;  ///< indices of the sticks, ascending
  std::vector<glm::dvec3> offset;    ///< per stick: the top mass relative to its base, R
  std::vector<glm::dvec3> velocity;  ///< per stick: the velocity of the top mass, R/s, in the object's frame
};
/// Computes about `count` sticks, evenly spaced by index. On shared prisms each stick depends on its
/// neighbours, so all sticks are computed, regardless of `count`.
SomeSticks some_reference_sticks(const FrameInput& input, int frames, std::size_t count);

}  // namespace pelage::springs
