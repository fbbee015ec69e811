// The pinhole camera of docs/frame.md, section 4.
#pragma once
#include <span>

#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// The camera of `scene.camera` for a picture of `scene.image`'s size. When framed, it looks along -direction
/// at the middle of what `points` (R) and a margin of `margin` R around each cover on screen, from where they
/// fill 88% of the picture's height or 94% of its width, whichever comes first.
Camera make_camera(const CameraScene& scene, const ImageScene& image, std::span<const glm::vec3> points,
                   float margin);

}  // namespace pelage
