// How much of a picture the model takes, and how much of a model is wet.
#pragma once
#include <glm/vec4.hpp>
#include <vector>

#include "harness/compare/shares.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/picture/picture.hpp"

namespace pelage {

/// Share of the picture's rows that hold fur, 0..1.
double model_height(const Picture& picture);

/// Share of the mesh's area whose mask texel is wet, 0..1. `mask` is side x side texels (c_u, c_v, r, rho).
double wet_share(const Mesh& mesh, const std::vector<glm::vec4>& mask, int side);

}  // namespace pelage
