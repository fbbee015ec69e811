// The frame's textures in OpenGL: the same texels, filtered by the driver (docs/frame.md, 6).
#pragma once
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opengl/objects.hpp"
#include "harness/shells/opengl/opengl.hpp"

namespace pelage::rivals {

/// The fur volume with its own mip levels: one texture, or with fur=slices one per layer.
std::vector<Object> fur_textures(const FurTexture& fur, const OpenGlOptions& options);
Object coat_texture(const CoatTexture& coat, const OpenGlOptions& options);
/// c_u, c_v, r, rho as floats; NEAREST.
Object mask_texture(const std::vector<glm::vec4>& mask, int size);

}  // namespace pelage::rivals
