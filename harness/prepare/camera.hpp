// The pinhole camera of docs/frame.md, section 4.
#pragma once
#include <span>

#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Returns the camera for a picture of the size that `image` gives. If scene.framed is true, the camera looks
/// along -scene.direction. It is placed so that all `points` (R), extended by `margin` (R) on every side, are
/// centred in the picture and fill 88% of its height or 94% of its width, whichever is reached first. Throws
/// InputError if eye and target coincide.
Camera make_camera(const CameraScene& scene, const ImageScene& image, std::span<const glm::vec3> points,
                   float margin);

}  // namespace pelage
