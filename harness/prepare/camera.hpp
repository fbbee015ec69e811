// The pinhole camera of docs/shells.md, section 4.
#pragma once
#include <span>

#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Returns the camera for a picture of the size that `image` gives. If scene.framed is true, the camera looks
/// along -scene.direction and shows all `points` in the centre of the picture. Each point is extended by
/// `margin` on every side. Coordinates and margin are in R. The extended points fill at most 88% of the
/// picture's height and at most 94% of its width. The camera is as near to the points as these limits permit,
/// but the view depth of every point is at least 2 * scene.near. Throws InputError if eye and target
/// coincide.
Camera make_camera(const CameraScene& scene, const ImageScene& image, std::span<const glm::vec3> points,
                   float margin);

}  // namespace pelage
