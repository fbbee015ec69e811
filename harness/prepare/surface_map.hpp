// The map from the texels of UV space to points of the surface.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/mesh/mesh.hpp"

namespace pelage {

/// Returns size x size surface points, in R (the mesh radius). Row j of the result is at v = (j+.5)/size. A
/// texel whose centre is in no UV triangle gets the point of the nearest covered texel. Distances are
/// measured in UV. If the UV map is periodic, distances wrap around the unit square.
std::vector<glm::vec3> surface_map(const Mesh& mesh, int size);

}  // namespace pelage
