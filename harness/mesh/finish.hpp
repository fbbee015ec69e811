// The last step: a surface with UV becomes the Mesh that the pipelines read.
#pragma once
#include <glm/mat3x3.hpp>

#include "harness/mesh/mesh.hpp"
#include "harness/mesh/surface.hpp"

namespace pelage {

/// Turns by `degrees` about x, then y, then z.
glm::dmat3 rotation_matrix(glm::dvec3 degrees);

/// Turns by `rotation` (degrees about x, then y, then z), normalises positions to the unit sphere and the UV
/// map into [0,1]^2 (isotropic maps keep their aspect), splits seam points into copies, sorts everything
/// along a Morton curve.
Mesh finish(const Surface& surface, const std::string& name, glm::dvec3 rotation);

/// The mesh turned by `rotation` (degrees about x, then y, then z), sorted along a Morton curve again; only
/// positions and orders change. The mesh itself where the rotation is 0.
Mesh turned(Mesh mesh, glm::dvec3 rotation);

/// The hash of everything that a picture depends on: arrays and flags, not the name or the notes.
std::string content_hash(const Mesh& mesh);

}  // namespace pelage
