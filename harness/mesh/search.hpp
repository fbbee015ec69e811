// Finds nearest points on a mesh and intersections of rays with a mesh, by CGAL's AABB tree.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "harness/mesh/mesh.hpp"

namespace pelage {

/// A point on the surface.
struct SurfacePlace {
  std::uint32_t triangle = 0;
  glm::vec3 weight{0};  ///< barycentric weights of the triangle's corners; the sum is 1
  glm::vec3 point{0};   ///< position in R, the mesh radius
  glm::vec2 uv{0};
};

/// A search tree of a mesh. It is built once, by the constructor; copies share it. Several threads may search
/// at the same time.
class SurfaceSearch {
 public:
  explicit SurfaceSearch(std::shared_ptr<const Mesh> mesh);
  SurfacePlace closest(glm::vec3 point) const;
  /// Returns the first intersection of the surface with the ray from `origin` along `direction` (not zero);
  /// empty if there is no intersection.
  std::optional<SurfacePlace> ray(glm::vec3 origin, glm::vec3 direction) const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace pelage
