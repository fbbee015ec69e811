// Roots of strands: the points of the surface at which strands begin.
#pragma once
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/mesh/mesh.hpp"

namespace pelage::strands {

/// A point of the surface.
struct Root {
  std::uint32_t face = 0;  ///< index of the triangle
  /// Barycentric weights of the triangle's second and third corner. They and their sum are in [0, 1]. The
  /// weight of the first corner is 1 minus their sum.
  glm::vec2 weight{0.0f};
};

/// Returns the position of the root. The unit of length is R, the radius of the mesh's bounding sphere.
glm::dvec3 position_of(const Mesh& mesh, const Root& root);

/// Returns the UV of the root.
glm::dvec2 uv_of(const Mesh& mesh, const Root& root);

/// Returns the relative density of strands at a root, in [0, 1].
using Density = std::function<double(const Root&)>;

/// Returns exactly `count` roots. Their number per area is proportional to `density`. The roots are blue
/// noise: they are random, but no two roots on the same side of the surface are near each other. Where the
/// density is below 1/16, the distances are less even. Every prefix of the result is blue noise, too, so
/// pelage removes strands from the end of the list if it needs fewer strands. The same arguments give the
/// same roots on every machine. Throws InputError if the density is 0 on almost the whole surface.
///
/// The method is dart throwing with a radius that shrinks until there are enough roots (McCool and Fiume,
/// Hierarchical Poisson Disk Sampling Distributions, 1992). `bare` saves time: for each triangle, it is true
/// if the density is known to be 0 on the whole triangle. An empty list stands for false everywhere.
std::vector<Root> scatter_roots(const Mesh& mesh, const Density& density, std::size_t count,
                                std::uint32_t seed, const std::vector<bool>& bare = {});

}  // namespace pelage::strands
