// The mesh without its UV seams: triangles over surface points, and what is around each point.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/mesh/mesh.hpp"

namespace pelage {

struct Skin {
  std::vector<glm::uvec3> triangle;       ///< F, surface points
  std::vector<glm::dvec3> position;       ///< W, R
  std::vector<std::uint32_t> first_copy;  ///< W, the lowest vertex copy of the point
  std::vector<double> area;               ///< F, R^2
  std::vector<glm::dvec3> face_normal;    ///< F, unit; a face without area borrows its corners'
  std::vector<glm::dvec3> normal;         ///< W, unit, area-weighted
  std::vector<std::uint32_t> row;         ///< W + 1: faces around point w are face[row[w] .. row[w+1])
  std::vector<std::uint32_t> face;        ///< ascending within a row, each face once
};

Skin weld(const Mesh& mesh);

/// Repeatedly replaces every vector by the mean of itself and its neighbours' along edges, made tangential to
/// the surface again; with `unit`, of length 1. All points move at once, so their order does not matter.
std::vector<glm::dvec3> smooth_tangents(const Skin& skin, std::vector<glm::dvec3> field, int iterations,
                                        bool unit);

/// The part of `v` in the plane of unit normal `n`.
glm::dvec3 tangential(glm::dvec3 v, glm::dvec3 n);

/// Some unit vector in the plane of unit normal `n`.
glm::dvec3 any_tangent(glm::dvec3 n);

}  // namespace pelage
