// The mesh as every later stage sees it. CGAL stays behind this header.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace pelage {

/// A prepared triangle mesh with a UV atlas. Lengths in R: the bounding sphere is centred on the origin and
/// has radius 1. A vertex on a UV seam has one copy per chart side; `weld` names the surface point that its
/// copies share. Vertices, surface points and triangles are in Morton order.
struct Mesh {
  std::string name;
  std::string hash;                         ///< hex hash of the content below, for caches and provenance
  std::vector<glm::vec3> position;          ///< V copies
  std::vector<glm::vec2> uv;                ///< V, in [0,1]^2
  std::vector<std::uint32_t> weld;          ///< V, the surface point of each copy, in [0, welded)
  std::vector<glm::uvec3> triangle;         ///< F, copies, counter-clockwise seen from outside
  std::uint32_t welded = 0;                 ///< W, number of surface points
  bool periodic_uv = false;                 ///< the UV square wraps (torus): textures repeat seamlessly
  /// Mean surface length per unit of u and of v, in R: the atlas's scale, one value per axis.
  glm::vec2 length_per_uv{1.0f, 1.0f};
};

}  // namespace pelage
