// Computes the input of a frame from a scene and its mesh.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Computes all arrays of the frame's input, such as the strands, the fur texture, the droplets and the
/// camera. The result depends only on the arguments and on the pictures that the scene names. Throws
/// InputError if the mesh has no triangles or a picture cannot be read.
std::shared_ptr<const FrameInput> prepare(const Scene& scene, std::shared_ptr<const Mesh> mesh);

/// Returns the points that a camera with camera.framed shows: the surface and the tips of the fur at rest, in
/// R. They do not depend on the camera.
std::vector<glm::vec3> framed_points(const FrameInput& input);

/// Returns the same input as prepare(scene, input.mesh), if `scene` differs from the scene of `input` only in
/// dynamics.time, in the keys of the camera and of the shading, and in the background. `points` is the result
/// of framed_points(input).
std::shared_ptr<const FrameInput> with_view(const FrameInput& input, const Scene& scene,
                                            std::span<const glm::vec3> points);

}  // namespace pelage
