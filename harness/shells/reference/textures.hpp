// Looking into the fur volume and the coat (docs/frame.md, 6). Texel (i, j) of a side S has its centre at
// ((i + .5) / S, (j + .5) / S); textures repeat.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "harness/prepare/frame_input.hpp"

namespace pelage::reference {

struct FurSample {
  double coverage;  ///< 0..1
  double shade;     ///< factor on the coat's colour
};

/// Slice `layer` at `uv` (in repeats), bilinear inside a mip level and linear between the two levels around
/// `level`, which is clamped to those that exist.
FurSample sample_fur(const FurTexture& fur, const glm::dvec2& uv, int layer, double level);

/// The coat's colour at uv, 0..1, bilinear.
glm::dvec3 sample_coat(const CoatTexture& coat, const glm::dvec2& uv);

}  // namespace pelage::reference
