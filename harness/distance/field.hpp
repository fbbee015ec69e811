// The body as a coarse signed distance field: a grid with the distance from the surface at each node.
#pragma once
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "harness/mesh/mesh.hpp"

namespace pelage {

/// Distances in R at the nodes of a regular grid, below 0 inside the body. docs/strands.md, section Body,
/// defines the values between the nodes.
struct DistanceField {
  std::string mesh;             ///< Mesh::hash
  glm::ivec3 nodes{0};          ///< number of nodes along each axis, at least 2
  glm::vec3 origin{0};          ///< position of node (0, 0, 0), R
  float cell = 0;               ///< distance between adjacent nodes, R
  std::vector<float> distance;  ///< index of node (x, y, z): x + nodes.x (y + nodes.y z)
};

/// Returns the distance field of a closed mesh. `cells` is the number of cells along the longest side of the
/// mesh's bounding box, 4 to 256. The grid extends at least 2 cells beyond the bounding box on all sides.
/// Throws InputError if the mesh is not closed, or if `cells` is out of range.
DistanceField distance_field(const std::shared_ptr<const Mesh>& mesh, int cells = 64);

/// Returns the field of distance_field() from the cache on disk (subfolder `fields` of cache_folder()), or
/// computes the field and writes it to the cache.
std::shared_ptr<const DistanceField> kept_distance_field(const std::shared_ptr<const Mesh>& mesh,
                                                         int cells = 64);

/// Returns the field's value at a point (trilinear interpolation), R. A point outside the grid has the value
/// of the nearest point of the grid.
double value_at(const DistanceField& field, glm::dvec3 point);

}  // namespace pelage
