// Networks of masses and springs over a surface: the four topologies of Banisch and Wuethrich 2006,
// section 4.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/scene/spring_kinds.hpp"

namespace pelage::springs {

/// Selects the places of the sticks in the topologies sticks and prisms: one stick on each surface point, so
/// that the topology is connected across UV seams, or on each vertex of the mesh (`copies`), which splits the
/// topology along the seams. Banisch and Wuethrich do not state whether they count surface points or vertices
/// (docs/springs.md). The separable topologies always have one stick at each corner of each triangle.
enum class Vertices { points, copies };

/// Selects the position at which the gusts on a stick are computed: its base, so that all sticks at a surface
/// point have the same wind, or the centroid of its triangle, so that they have different gusts and can move
/// apart. In the topologies sticks and prisms, several triangles share a stick, and the position is always
/// the base.
enum class Gusts { sticks, triangles };

/// Masses and springs of a topology. Mass i is the base of stick i and is fixed to the skin. Mass
/// i + sticks() is its top and can move. The first sticks() springs are the sticks. The other springs connect
/// tops, and each of them occurs once. In the separable topologies, stick 3 * f + c stands on corner c of
/// triangle f. In separable-prisms, the springs between the tops of triangle f connect corners (0, 1), (1, 2)
/// and (2, 0), in that order.
struct SpringNetwork {
  Kind kind = Kind::sticks;
  std::vector<glm::vec3> mass;       ///< rest position of each mass in R
  std::vector<glm::vec3> normal;     ///< for each stick, its direction at rest (unit vector)
  std::vector<std::uint32_t> copy;   ///< for each stick, the index of the mesh vertex at its base
  std::vector<std::uint32_t> point;  ///< for each stick, the index of the surface point at its base
  std::vector<glm::vec3> gust_at;    ///< for each stick, the position in R at which the gusts are computed
  std::vector<glm::uvec2> spring;    ///< indices of the two masses of each spring
  std::vector<float> rest;           ///< rest length of each spring in R
  std::vector<glm::uvec3> corner;    ///< for each mesh triangle, the indices of the sticks at its corners
  float length = 0;                  ///< rest length L0 of the sticks in R
  double stick_area = 0;             ///< area of the surface in R^2 divided by the number of sticks

  std::size_t sticks() const { return normal.size(); }
  std::size_t top(std::size_t stick) const { return sticks() + stick; }
  std::span<const glm::uvec2> edges() const { return std::span(spring).subspan(sticks()); }
};

/// Builds the topology with sticks of `length` R (above 0) along the area-weighted vertex normals. All sticks
/// at one surface point have the same rest position, so at rest the topologies separable-sticks and
/// separable-prisms have no gaps between adjacent triangles. If a triangle edge connects a surface point with
/// itself, no spring is built for it. Throws InputError if the mesh has no triangle or the length is not
/// above 0.
SpringNetwork build(Kind kind, const Mesh& mesh, float length, Vertices vertices = Vertices::points,
                    Gusts gusts = Gusts::sticks);

/// Returns the index of the first triangle of `mesh` that the ray from `origin` (in R) along `direction`
/// hits. Both sides of a triangle can be hit. Returns nothing if the ray hits no triangle.
std::optional<std::size_t> hit(const Mesh& mesh, glm::dvec3 origin, glm::dvec3 direction);

/// Largest number of triangles that drawing_of accepts. In larger meshes the triangles are too small to
/// distinguish on a page.
inline constexpr std::size_t most_drawn = 20000;

/// Returns an SVG with one panel per topology. Each panel shows the surface of `mesh` from the front and
/// slightly from above, the sticks in one colour and the springs between tops in another. Sticks and springs
/// behind the surface are hidden. Of the separable topologies, each mass is drawn nearer to the centre of its
/// triangle, so that gaps between the triangles are visible, as in Figure 5b of the paper. `length` is the
/// rest length of the sticks in R, above 0. Throws InputError if the mesh has more than most_drawn triangles.
std::string drawing_of(const Mesh& mesh, float length);

/// Least, largest and mean number of springs at a top mass.
struct Degrees {
  int least = 0, most = 0;
  double mean = 0;
};
Degrees degrees(const SpringNetwork& network);

}  // namespace pelage::springs
