// Measures the height of a model in a picture, and the wet share of a model's surface.
#pragma once
#include <glm/vec4.hpp>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/picture/picture.hpp"

namespace pelage {

/// Returns the share of the picture's pixel rows that contain fur, 0..1.
double model_height(const Picture& picture);

/// Returns the area of the triangles whose mask texel is wet, as a share of the mesh's area, 0..1. `mask` has
/// side x side texels. A texel (c_u, c_v, r, rho) contains the centre, the radius and the wetness of a clump.
/// A texel is wet if rho is above 0. The mask texel of a triangle is the texel at the mean of the triangle's
/// three UV positions.
double wet_share(const Mesh& mesh, const std::vector<glm::vec4>& mask, int side);

}  // namespace pelage
