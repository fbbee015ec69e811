// A topology's sticks in double precision: what the device's are held against, and what the reference's
// pictures are drawn with.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::springs {

/// Top less base of every stick, R, `frames` frames after rest, by reference.hpp.
std::vector<glm::dvec3> reference_sticks(const FrameInput& input, int frames);

/// The same of about `count` sticks, evenly spread; only where no stick waits for its neighbours, so that
/// they alone have to be moved. Prisms that share their tops are moved whole, whatever `count` says.
struct SomeSticks {
  std::vector<std::uint32_t> stick;  ///< ascending
  std::vector<glm::dvec3> offset;    ///< of each, R
  std::vector<glm::dvec3> velocity;  ///< of each top, R/s, in the object's frame
};
SomeSticks some_reference_sticks(const FrameInput& input, int frames, std::size_t count);

}  // namespace pelage::springs
