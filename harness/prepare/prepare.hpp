// From a scene and a mesh to everything a frame is computed from.
#pragma once
#include <memory>

#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Plants the strands, paints coat and fur texture, places droplets and camera. Depends on nothing but its
/// arguments (and the pictures the scene names). Throws InputError for a picture that cannot be read.
std::shared_ptr<const FrameInput> prepare(const Scene& scene, std::shared_ptr<const Mesh> mesh);

}  // namespace pelage
