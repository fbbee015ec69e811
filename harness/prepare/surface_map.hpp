// The surface laid out in the atlas: which point of it lies under each texel.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/mesh/mesh.hpp"

namespace pelage {

/// size x size surface points in R, row j growing with v. A texel whose centre no triangle covers takes the
/// point of the nearest covered texel (nearest in UV; across the borders of the square on a periodic atlas).
std::vector<glm::vec3> surface_map(const Mesh& mesh, int size);

}  // namespace pelage
