// The view from which the opacity map of the key light is drawn (docs/strands.md, section Shadow). R is the
// radius of the mesh's bounding sphere.
#pragma once
#include <glm/vec4.hpp>

#include "harness/strands/drawing/drawing.hpp"

namespace pelage::strands {

/// A parallel projection along the key light. The product of a row with (p, 1) gives, for a point p in the
/// object's frame: x and y in texels from the centre of the map, and z, the distance in R that grows away
/// from the light.
struct LightView {
  glm::vec4 row_x{0}, row_y{0}, row_z{0};
  float texel = 1;  ///< side of a texel, R
  int size = 1;     ///< texels per side of the map
};

/// Returns the view along look.light of a map with look.shadow.size texels per side. The ball with the radius
/// look.shadow.radius around the object's origin fills the map, with a margin of two texels on each side.
LightView light_view(const Look& look);

}  // namespace pelage::strands
