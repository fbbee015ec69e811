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

  /// Returns the scale at a point of a triangle: the length on the surface, in R, per unit of UV. `weight`
  /// are the point's barycentric coordinates. At a vertex, the scale is sqrt(surface area / UV area) of the
  /// triangles around it. Between the vertices, it is interpolated linearly.
  double at(std::size_t face, glm::dvec3 weight) const;

 private:
  std::shared_ptr<const Mesh> mesh_;
  std::vector<double> length_;  ///< at each vertex of the mesh
};

}  // namespace pelage
