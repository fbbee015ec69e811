// Texture lookups in the fur and the coat (docs/shells.md, section 6). Texel (i, j) of a texture of side S
// has its centre at ((i + .5) / S, (j + .5) / S). Textures repeat.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "harness/prepare/frame_input.hpp"

namespace pelage::reference {

struct FurSample {
  double coverage;  ///< 0..1
  double shade;     ///< factor on the coat's colour, 0..2
};

/// Samples slice `layer` of the fur at `uv`. The texture has the period 1 in u and v. Filtering is bilinear
/// within a mip level, and linear between the two mip levels around `level`. `level` is clamped to the
/// existing mip levels. The coverage c becomes 1 - (1 - c)^power.
FurSample sample_fur(const FurTexture& fur, const glm::dvec2& uv, int layer, double level, double power);

/// Returns the value of a map at uv by bilinear filtering between pixel centres. Outside the unit square, the
/// value is that of the nearest point of the square. Returns 1 if there is no map.
double sample_density(const Style::Density& map, const glm::dvec2& uv);

/// Returns the coat's colour at uv by bilinear filtering. Channels are 0..1.
glm::dvec3 sample_coat(const CoatTexture& coat, const glm::dvec2& uv);

}  // namespace pelage::reference
