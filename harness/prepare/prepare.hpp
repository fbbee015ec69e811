// Computes the input of a frame from a scene and its mesh.
#pragma once
#include <memory>

#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Computes all arrays of the frame's input, such as the strands, the fur texture, the droplets and the
/// camera. The result depends only on the arguments and on the pictures that the scene names. Throws
/// InputError if the mesh has no triangles or a picture cannot be read.
std::shared_ptr<const FrameInput> prepare(const Scene& scene, std::shared_ptr<const Mesh> mesh);

}  // namespace pelage
