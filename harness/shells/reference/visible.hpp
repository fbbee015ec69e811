// Which triangles a part of the picture can see, in whatever layer: so that only those are worked on.
#pragma once
#include <cstdint>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::reference {

/// The windows (none: the whole picture) cut to the picture and into pieces of at most 64 x 64 pixels.
std::vector<Window> split(const std::vector<Window>& windows, const Camera& camera);

/// The faces, in the mesh's order, that may cover a pixel of the window in some layer: a superset, from a
/// ball around each triangle that holds it on every layer, whatever its strands do.
std::vector<std::uint32_t> visible_faces(const FrameInput& input, const Window& window);

}  // namespace pelage::reference
