// Masses and springs over a surface: the four topologies of Banisch and Wuethrich 2006, section 4.
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

/// What a vertex of the paper is. On surface points a shared topology is one piece; on vertex copies, which
/// the paper's own counts are, it also parts along the seams of the UV map. Separable ones are the same on
/// both.
enum class Vertices { points, copies };

/// Stick i runs from mass i, fixed to the skin, to mass i + sticks(), on the outermost layer. The first
/// sticks() springs are the sticks; the others lie between tops, each once. Stick 3f + c of a separable
/// topology stands on corner c of triangle f, and its springs between tops are (c, c + 1) in that order.
struct SpringNetwork {
  Kind kind = Kind::sticks;
  std::vector<glm::vec3> mass;      ///< M, rest positions, R
  std::vector<glm::vec3> normal;    ///< M / 2, unit: the direction in which the stick rests
  std::vector<std::uint32_t> copy;  ///< M / 2, the vertex copy of the mesh that the stick stands on
  std::vector<glm::uvec2> spring;   ///< masses
  std::vector<float> rest;          ///< per spring, its rest length, R
  std::vector<glm::uvec3> corner;   ///< F, the sticks at the corners of each triangle of the mesh
  float length = 0;                 ///< L0, R: the rest length of the sticks

  std::size_t sticks() const { return normal.size(); }
  std::size_t top(std::size_t stick) const { return sticks() + stick; }
  std::span<const glm::uvec2> edges() const { return std::span(spring).subspan(sticks()); }
};

/// The topology of sticks `length` long (R, above 0) along the surface's area-weighted vertex normals: all
/// sticks at a surface point rest in the same place, so that separable layers are closed at rest. Edges whose
/// ends are one point carry no spring in a shared topology. Throws InputError for a mesh without a triangle
/// and for a length that is not above 0.
SpringNetwork build(Kind kind, const Mesh& mesh, float length, Vertices vertices = Vertices::points);

/// The triangle of `mesh` that the ray from `origin` along `direction` (R) meets first, from either side;
/// empty when it meets none.
std::optional<std::size_t> hit(const Mesh& mesh, glm::dvec3 origin, glm::dvec3 direction);

/// A local poke: `force` (N) on each of the sticks at the corners of triangle `face`, none on the others.
std::vector<glm::vec3> poke(const SpringNetwork& topology, std::size_t face, glm::vec3 force);

/// How many springs hang on each top.
struct Degrees {
  int least = 0, most = 0;
  double mean = 0;
};
Degrees degrees(const SpringNetwork& topology);

}  // namespace pelage::springs
