// The colliders of a scene (docs/shells.md, section 9) for the shaders.
#pragma once
#include "harness/gl/objects.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::rivals {

/// Returns the "#define" lines of the scene's colliders; "" without colliders.
std::string contact_defines(const FrameInput& input);

/// Returns the distance field of the mesh among the colliders as a 3D texture; one texel without a mesh.
gl::Object field_texture(const FrameInput& input);

/// Sets the uniforms of shaders/contact.glsl in `program` to the colliders at `time`, in s since the start of
/// the simulation.
void set_colliders(GLuint program, const FrameInput& input, double time);

}  // namespace pelage::rivals
