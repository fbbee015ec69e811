// Texture lookups in the fur and the coat (docs/frame.md, section 6). Texel (i, j) of a texture of side S has
// its centre at ((i + .5) / S, (j + .5) / S). Textures repeat.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "harness/prepare/frame_input.hpp"

namespace pelage::reference {

struct FurSample {
  double coverage;  ///< 0..1
  double shade;     ///< factor on the coat's colour, 0..2
};

/// Samples slice `layer` at `uv`, in units of the texture's period. Filtering is bilinear within a mip level,
/// and linear between the two levels around `level`. `level` is clamped to the existing levels.
FurSample sample_fur(const FurTexture& fur, const glm::dvec2& uv, int layer, double level);

/// Returns the coat's colour at uv by bilinear filtering. Channels are 0..1.
glm::dvec3 sample_coat(const CoatTexture& coat, const glm::dvec2& uv);

}  // namespace pelage::reference
