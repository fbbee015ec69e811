// The last step of mesh preparation: it converts a surface with a UV map to the Mesh that the pipelines read.
#pragma once
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/mesh/surface.hpp"

namespace pelage {

/// Returns the matrix of a rotation by `degrees` about the fixed axes x, then y, then z.
glm::dmat3 rotation_matrix(glm::dvec3 degrees);

/// Rotates points of a UV map counter-clockwise about the origin.
struct UvTurn {
  double c, s;
  explicit UvTurn(double degrees) : c(std::cos(glm::radians(degrees))), s(std::sin(glm::radians(degrees))) {}
  glm::dvec2 operator()(glm::dvec2 p) const { return {c * p.x - s * p.y, s * p.x + c * p.y}; }
};

/// Rotates and scales the UV map into [0,1]^2, as finish() does.
void fit_uv(Surface& surface);

/// Rotates the surface by `rotation` (degrees about x, then y, then z) and scales it to the unit bounding
/// sphere. A periodic UV map stays unchanged. The UV map of a file and a map of packed charts stay unchanged
/// if they lie in [0,1]^2. All other UV maps are rotated and scaled into [0,1]^2. Splits each point on a UV
/// seam into several vertices, one for each UV. Sorts points, vertices and triangles along a Morton curve.
Mesh finish(const Surface& surface, const std::string& name, glm::dvec3 rotation);

/// Rotates a finished mesh by `rotation` (degrees about x, then y, then z) and sorts it along a Morton curve
/// again. Adds a description of the rotation to Mesh::notes and updates Mesh::hash. If `rotation` is zero,
/// the mesh is returned unchanged.
Mesh turned(Mesh mesh, glm::dvec3 rotation);

/// Returns a hash of all data of the mesh that influence a picture: the arrays and flags, but not the name
/// and the notes.
std::string content_hash(const Mesh& mesh);

struct Sphere {
  glm::dvec3 centre{0};
  double radius;
};

/// Returns the smallest sphere that contains all points (CGAL's Min_sphere_of_spheres_d).
Sphere bounding_sphere(const std::vector<glm::dvec3>& points);

}  // namespace pelage
