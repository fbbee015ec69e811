// Makes OpenGL textures from the textures of a frame. OpenGL does the filtering that docs/shells.md, section
// 6, defines.
#pragma once
#include <vector>

#include "harness/gl/objects.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opengl/opengl.hpp"

namespace pelage::rivals {

/// Returns the fur texture with the mip levels of `fur`.
gl::Object fur_texture(const FurTexture& fur, const OpenGlOptions& options);
gl::Object coat_texture(const CoatTexture& coat, const OpenGlOptions& options);
/// Returns the wetness mask as a texture of floats with NEAREST filtering. The four floats of a texel are the
/// centre (u, v) and the radius of a clump, and the wetness.
gl::Object mask_texture(const std::vector<glm::vec4>& mask, int size);

/// Returns the map of the density as a texture; a texture of one texel without a map. The top row of the
/// texture is at v = 1.
gl::Object density_texture(const Style::Density& map);
/// Returns the angles of the curls for all factors of curl.turns: the texel (k, n) holds the cosine and the
/// sine of the angle in layer n for the factor k / turn_steps, times the height of the layer. One texel
/// without curl.turns_map.
gl::Object turns_texture(const FrameInput& input);

}  // namespace pelage::rivals
