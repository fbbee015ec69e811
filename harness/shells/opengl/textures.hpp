// The frame's textures in OpenGL. The driver filters the texels that docs/frame.md, section 6, defines.
#pragma once
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opengl/objects.hpp"
#include "harness/shells/opengl/opengl.hpp"

namespace pelage::rivals {

/// Returns the fur with its own mip levels: one texture, or one texture per layer with fur=slices.
std::vector<Object> fur_textures(const FurTexture& fur, const OpenGlOptions& options);
Object coat_texture(const CoatTexture& coat, const OpenGlOptions& options);
/// Returns the mask as a texture of floats (c_u, c_v, r, rho) with NEAREST filtering.
Object mask_texture(const std::vector<glm::vec4>& mask, int size);

}  // namespace pelage::rivals
