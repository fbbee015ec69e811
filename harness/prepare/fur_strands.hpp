// The hairs of the fur texture: their roots, shapes and shades.
#pragma once
#include <glm/vec2.hpp>
#include <vector>

#include "harness/scene/scene.hpp"

namespace pelage {

/// One hair of the square texture, which repeats over the surface. Lengths in the texture's plane are
/// fractions of the square's side.
struct FurStrand {
  glm::dvec2 root{0};       ///< in [0,1)^2
  glm::dvec2 pull{0};       ///< displacement of the tip towards its lock's centre
  glm::dvec2 bend{0};       ///< offset of a blade's tip by its bend
  double steep = 2.5;       ///< c of the bend's exponential curve
  double length = 1;        ///< fraction of L0
  double radius = 0;        ///< radius at the root
  double width = 1;         ///< ratio of a blade's width along `across` to its thickness
  glm::dvec2 across{0, 1};  ///< unit vector across the bend
  double shade = 1;         ///< factor on the coat's colour
};

/// Returns all hairs, guard hairs first, then the undercoat. The roots are on a jittered grid that repeats
/// with the square.
std::vector<FurStrand> grow_strands(const FurScene& fur);

/// Centre of the strand's cross-section at height h (0..1, fraction of L0). It may lie outside the unit
/// square.
glm::dvec2 strand_centre(const FurStrand& strand, const FurScene& fur, double h);

/// Radius of the strand's cross-section at height h <= length. The radius decreases from the root to the tip,
/// where it is fur.tip_radius times the root's radius. Then the section is widened to a disc of the area
/// pi r^2 + 2 r spacing fur.sweep, where `spacing` is the distance of two slices. A ray whose angle to the
/// strand has the tangent fur.sweep hits the strand between two slices if it enters this area. Without the
/// widening, rays pass between the sections of a strand if layers are few, and the fur becomes thinner and
/// darker.
double strand_radius(const FurStrand& strand, const FurScene& fur, double h);

/// Returns `count` points that are evenly distributed over [0,1)^2. The rows have nearly equal numbers of
/// cells, and each cell has one point at a random position.
std::vector<glm::dvec2> jittered_points(int count, std::uint32_t seed, std::uint32_t stream);

}  // namespace pelage
