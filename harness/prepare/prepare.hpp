// Computes the input of a frame from a scene and its mesh, and the pinhole camera of docs/shells.md,
// section 4.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Whether prepare() accepts a mesh that deforms.
enum class Deforming { refused, followed };

/// Computes all arrays of the frame's input, such as the strands, the fur texture, the droplets and the
/// camera. The result depends only on the arguments and on the pictures that the scene names. Throws
/// InputError if the mesh has no triangles or a picture cannot be read. The surface of a mesh that deforms is
/// that of its first frame (moving_skin.hpp has the others), and the camera shows all frames; with
/// Deforming::refused, such a mesh is an InputError.
std::shared_ptr<const FrameInput> prepare(const Scene& scene, std::shared_ptr<const Mesh> mesh,
                                          Deforming deforming = Deforming::refused);

/// Returns the points that a camera with camera.framed shows: the surface and the tips of the fur at rest, in
/// R. They do not depend on the camera.
std::vector<glm::vec3> framed_points(const FrameInput& input);

/// Returns the same input as prepare(scene, input.mesh), if `scene` differs from the scene of `input` only in
/// dynamics.time, in the keys of the camera and of the shading, and in the background. `points` is the result
/// of framed_points(input).
std::shared_ptr<const FrameInput> with_view(const FrameInput& input, const Scene& scene,
                                            std::span<const glm::vec3> points);

/// Returns the camera for a picture of the size that `image` gives. If scene.framed is true, the camera looks
/// along -scene.direction and shows all `points` in the centre of the picture. Each point is extended by
/// `margin` on every side. Coordinates and margin are in R. The extended points fill at most 88% of the
/// picture's height and at most 94% of its width. The camera is as near to the points as these limits permit,
/// but the view depth of every point is at least 2 * scene.near. Throws InputError if eye and target
/// coincide.
Camera make_camera(const CameraScene& scene, const ImageScene& image, std::span<const glm::vec3> points,
                   float margin);

}  // namespace pelage
