// Finds the triangles that a part of the picture can show in any layer, so that the reference computes only
// those.
#pragma once
#include <cstdint>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::reference {

/// Clips the windows to the picture and splits them into pieces of at most 64 x 64 pixels. An empty list
/// means the whole picture.
std::vector<Window> split(const std::vector<Window>& windows, const Camera& camera);

/// Returns the faces, in the mesh's order, that may cover a pixel of the window in some layer. The result can
/// contain more faces, because each triangle is replaced by a ball that contains it on every layer, for any
/// motion of its strands.
std::vector<std::uint32_t> visible_faces(const FrameInput& input, const Window& window);

}  // namespace pelage::reference
