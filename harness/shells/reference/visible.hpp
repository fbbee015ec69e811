// Finds the triangles of which at least one layer can be visible in a part of the picture. The reference
// renderer computes only these triangles.
#pragma once
#include <cstdint>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::reference {

/// Clips the windows to the picture and splits them into windows of at most 64 x 64 pixels. If `windows` is
/// empty, the function splits the whole picture.
std::vector<Window> split(const std::vector<Window>& windows, const Camera& camera);

/// Returns the faces that may cover a pixel of the window on some layer, in the mesh's order. For each face,
/// the function tests a ball that contains the face on all layers, no matter how the strands move. The result
/// can therefore contain faces that cover no pixel of the window.
std::vector<std::uint32_t> visible_faces(const FrameInput& input, const Window& window);

}  // namespace pelage::reference
