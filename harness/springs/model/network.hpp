// Networks of masses and springs over a surface: the four topologies of Banisch and Wuethrich 2006,
// section 4.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/scene/spring_kinds.hpp"

namespace pelage::springs {

/// The vertices on which a shared topology is built. With `points` it is built on surface points and is
/// connected across UV seams. With `copies` it is built on vertex copies, as in the paper's counts, and is
/// split along UV seams. Separable topologies do not depend on this choice.
enum class Vertices { points, copies };

/// Masses and springs of a topology. Stick i connects mass i, which is fixed to the skin, with mass i +
/// sticks(), its top mass on the outermost layer. The first sticks() springs are the sticks. The other
/// springs connect tops; each occurs once. In a separable topology stick 3f + c stands on corner c of
/// triangle f, and the springs between the tops of f connect corners (0, 1), (1, 2) and (2, 0), in that
/// order.
struct SpringNetwork {
  Kind kind = Kind::sticks;
  std::vector<glm::vec3> mass;      ///< M masses: rest positions, R
  std::vector<glm::vec3> normal;    ///< M / 2 unit vectors: the direction of each stick at rest
  std::vector<std::uint32_t> copy;  ///< M / 2: the vertex of the mesh that each stick stands on
  std::vector<glm::uvec2> spring;   ///< indices of the two masses of each spring
  std::vector<float> rest;          ///< rest length of each spring, R
  std::vector<glm::uvec3> corner;   ///< F: indices of the three sticks at the corners of each mesh triangle
  float length = 0;                 ///< L0: rest length of the sticks, R

  std::size_t sticks() const { return normal.size(); }
  std::size_t top(std::size_t stick) const { return sticks() + stick; }
  std::span<const glm::uvec2> edges() const { return std::span(spring).subspan(sticks()); }
};

/// Builds the topology with sticks of `length` R (above 0) along the area-weighted vertex normals. All sticks
/// at one surface point have the same rest position, so the layers of a separable topology are closed at
/// rest. In a shared topology an edge between two copies of one point gets no spring. Throws InputError if
/// the mesh has no triangle or the length is not above 0.
SpringNetwork build(Kind kind, const Mesh& mesh, float length, Vertices vertices = Vertices::points);

/// Returns the index of the first triangle of `mesh` that the ray from `origin` (R) along `direction` hits,
/// on either side. Returns nothing if the ray hits no triangle.
std::optional<std::size_t> hit(const Mesh& mesh, glm::dvec3 origin, glm::dvec3 direction);

/// Returns one force per stick, N: `force` for the three sticks at the corners of triangle `face`, 0 for all
/// others. Throws InputError if `face` is out of range or `force` is not finite.
std::vector<glm::vec3> poke(const SpringNetwork& topology, std::size_t face, glm::vec3 force);

/// Least, largest and mean number of springs at a top mass.
struct Degrees {
  int least = 0, most = 0;
  double mean = 0;
};
Degrees degrees(const SpringNetwork& topology);

}  // namespace pelage::springs
