// The colour of the fur as a function of the position on the surface.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Returns the coat's colours as a texture in UV space. They come from a picture or a pattern. A pattern is a
/// function of the position in space and therefore has no seams. Throws InputError for an unknown pattern or
/// an unreadable picture.
CoatTexture make_coat(const Mesh& mesh, const CoatScene& coat);

/// Returns the coat's colour at `uv`, each component 0 to 1. The value is interpolated linearly between the
/// centres of the texels. The texture repeats.
glm::dvec3 coat_colour(const CoatTexture& coat, glm::dvec2 uv);

}  // namespace pelage
