// The mesh without UV seams: triangles of surface points, and the triangles around each point.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/mesh/mesh.hpp"

namespace pelage {

struct Skin {
  std::vector<glm::uvec3> triangle;       ///< F, indices of surface points
  std::vector<glm::dvec3> position;       ///< W, R
  std::vector<std::uint32_t> first_copy;  ///< W, lowest index of a vertex at the point
  std::vector<double> area;               ///< F, R^2
  std::vector<glm::dvec3> face_normal;    ///< F, unit; for zero area the mean normal of the corners
  std::vector<glm::dvec3> normal;         ///< W, unit, area-weighted
  std::vector<std::uint32_t> row;         ///< W + 1; the faces around point w are face[row[w] .. row[w+1])
  std::vector<std::uint32_t> face;        ///< indices of faces, ascending and unique within a row
};

Skin weld(const Mesh& mesh);

/// Smooths a tangential vector field. Each iteration replaces the vector of a point by the mean of all
/// corners of the triangles around the point, projected onto the tangent plane; `unit` normalizes it to
/// length 1. All points are updated simultaneously, so the result does not depend on their order.
std::vector<glm::dvec3> smooth_tangents(const Skin& skin, std::vector<glm::dvec3> field, int iterations,
                                        bool unit);

/// The projection of `v` onto the plane with the unit normal `n`.
glm::dvec3 tangential(glm::dvec3 v, glm::dvec3 n);

/// An arbitrary unit vector in the plane with the unit normal `n`.
glm::dvec3 any_tangent(glm::dvec3 n);

}  // namespace pelage
