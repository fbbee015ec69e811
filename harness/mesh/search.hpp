// Points and rays against a prepared mesh (CGAL's AABB tree): from a place in space to a place in UV.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "harness/mesh/mesh.hpp"

namespace pelage {

/// A place on the surface.
struct SurfacePlace {
  std::uint32_t triangle = 0;
  glm::vec3 weight{0};  ///< of the triangle's corners; sums to 1
  glm::vec3 point{0};   ///< R
  glm::vec2 uv{0};
};

/// Holds a tree over the mesh, so that many questions cost one build. Asking is safe from several threads.
class SurfaceSearch {
 public:
  explicit SurfaceSearch(std::shared_ptr<const Mesh> mesh);
  ~SurfaceSearch();
  SurfaceSearch(SurfaceSearch&&) noexcept;
  SurfaceSearch& operator=(SurfaceSearch&&) noexcept;

  SurfacePlace closest(glm::vec3 point) const;
  /// The first place that the ray from `origin` along `direction` (not zero) meets; empty: none.
  std::optional<SurfacePlace> ray(glm::vec3 origin, glm::vec3 direction) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pelage
