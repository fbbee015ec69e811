// The mesh without UV seams: triangles of surface points, and the triangles around each point. Vertices that
// differ only in their UV are one surface point.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/mesh/mesh.hpp"

namespace pelage {

struct Skin {
  std::vector<glm::uvec3> triangle;  ///< surface points at the corners of each triangle
  std::vector<glm::dvec3> position;  ///< position of each surface point, in R (the mesh radius)
  /// For each surface point, the lowest index of its vertices in Mesh. A point on a UV seam has several
  /// vertices.
  std::vector<std::uint32_t> first_copy;
  std::vector<double> area;  ///< area of each triangle in R^2
  /// Unit normal of each triangle. For a triangle of area 0, it is the normalized sum of the values of
  /// `normal` at its corners.
  std::vector<glm::dvec3> face_normal;
  /// Unit normal at each surface point: the normalized, area-weighted mean of the normals of the triangles
  /// around the point.
  std::vector<glm::dvec3> normal;
  std::vector<std::uint32_t> row;   ///< face[row[w]] .. face[row[w + 1] - 1] are the triangles around point w
  std::vector<std::uint32_t> face;  ///< triangles around each point, in ascending order of index; see `row`
};

Skin weld(const Mesh& mesh);

/// Smooths a tangential vector field. In each iteration, the function computes for each point the mean of the
/// vectors at all corners of the triangles around the point. The projection of this mean onto the point's
/// tangent plane is the new vector of the point. If `unit` is true, the new vector is normalized. All points
/// are updated simultaneously, so the result does not depend on their order.
std::vector<glm::dvec3> smooth_tangents(const Skin& skin, std::vector<glm::dvec3> field, int iterations,
                                        bool unit);

/// Returns the projection of `v` onto the plane with the unit normal `n`.
glm::dvec3 tangential(glm::dvec3 v, glm::dvec3 n);

/// Returns an arbitrary unit vector in the plane with the unit normal `n`.
glm::dvec3 any_tangent(glm::dvec3 n);

}  // namespace pelage
