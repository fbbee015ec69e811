// The last step of mesh preparation: it converts a surface with a UV map to the Mesh that the pipelines read.
#pragma once
#include <glm/mat3x3.hpp>

#include "harness/mesh/mesh.hpp"
#include "harness/mesh/surface.hpp"

namespace pelage {

/// Returns the matrix of a rotation by `degrees` about the fixed axes x, then y, then z.
glm::dmat3 rotation_matrix(glm::dvec3 degrees);

/// Rotates the surface by `rotation` (degrees about x, then y, then z) and scales it to the unit bounding
/// sphere. Rotates and scales the UV map into [0,1]^2. Two kinds of UV maps stay unchanged: a periodic map;
/// and a file's own map, or a map of packed charts, if the map already lies in [0,1]^2. Splits points on UV
/// seams into copies, and sorts points, copies and triangles along a Morton curve.
Mesh finish(const Surface& surface, const std::string& name, glm::dvec3 rotation);

/// Rotates a finished mesh by `rotation` (degrees about x, then y, then z) and sorts it along a Morton curve
/// again. Adds a note and updates the hash. A rotation of 0 returns the mesh unchanged.
Mesh turned(Mesh mesh, glm::dvec3 rotation);

/// Returns a hash of all data of the mesh that influence a picture: the arrays and flags, but not the name
/// and the notes.
std::string content_hash(const Mesh& mesh);

}  // namespace pelage
