// The local scale of the UV map.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "harness/mesh/mesh.hpp"

namespace pelage {

class UvScale {
 public:
  explicit UvScale(std::shared_ptr<const Mesh> mesh);

  /// Returns the length on the surface, in R, per unit of UV at a point of a triangle, of which `weight` are
  /// the barycentric coordinates. The square of this length at a vertex is the ratio of surface area to UV
  /// area of the triangles at the vertex. The length is interpolated linearly between the vertices.
  double at(std::size_t face, glm::dvec3 weight) const;

 private:
  std::shared_ptr<const Mesh> mesh_;
  std::vector<double> length_;  ///< at each vertex of the mesh
};

}  // namespace pelage
