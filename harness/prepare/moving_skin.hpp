// The skin under layers on a mesh that moves and deforms (scene key mesh.frames; docs/springs.md, section
// Moving skin). Drawn frame k, counted from 0, shows frame k of the mesh. After the last one follows what the
// scene key mesh.after_frames says.
#pragma once
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Returns the mesh of `input` in drawn frame `frame`, without its other frames.
Mesh mesh_of_frame(const FrameInput& input, int frame);

/// Returns the mean velocity of each surface point from drawn frame `frame` - 1 to `frame`, in R/s. In frame
/// 0, and where the last frame of the mesh stays, it is 0.
std::vector<glm::dvec3> skin_velocity(const FrameInput& input, int frame);

/// Returns the scene of `input` and the arrays of FrameInput that depend on the skin, for drawn frame
/// `frame`. The other arrays are empty.
FrameInput skin_of_frame(const FrameInput& input, int frame);

/// Returns `input` with the skin of drawn frame `frame`, and without the mesh's other frames. If the mesh
/// does not deform, the result is `input`.
std::shared_ptr<const FrameInput> with_skin(std::shared_ptr<const FrameInput> input, int frame);

}  // namespace pelage
