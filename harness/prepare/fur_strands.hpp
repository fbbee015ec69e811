// The hairs of the fur texture: their roots, shapes and shades.
#pragma once
#include <glm/vec2.hpp>
#include <vector>

#include "harness/scene/scene.hpp"

namespace pelage {

/// One hair of the square texture, which repeats over the surface. Lengths in the texture's plane are
/// fractions of the square's side.
struct FurStrand {
  glm::dvec2 root{0};       ///< position of the root in the square, in [0,1)^2
  glm::dvec2 pull{0};       ///< displacement at height L0 towards the centre of the hair's lock
  glm::dvec2 bend{0};       ///< sideways offset of the tip because the hair is bent
  double steep = 2.5;       ///< exponent c of the bend, see FurScene::bend_exponent
  double length = 1;        ///< length of the hair, as a fraction of L0
  double radius = 0;        ///< radius of the hair at its root
  double width = 1;         ///< ratio of the cross-section's size along `across` to its size along the bend
  glm::dvec2 across{0, 1};  ///< unit vector perpendicular to the bend
  double shade = 1;         ///< factor of the coat's colour
};

/// Returns all hairs, guard hairs first, then the undercoat. The texture's square is divided into cells, and
/// each cell has one root at a random position (jittered_points()).
std::vector<FurStrand> grow_strands(const FurScene& fur);

/// Returns the centre of the strand's cross-section at height h (0..1, fraction of L0). The centre may lie
/// outside the unit square.
glm::dvec2 strand_centre(const FurStrand& strand, const FurScene& fur, double h);

/// Returns the radius of the strand's cross-section at height h <= length. The radius r of the hair itself
/// decreases from the root to the tip, where it is fur.tip_radius times the radius at the root. The function
/// returns the radius of a larger disc. Its area is pi r^2 + 2 r * spacing * fur.sweep, where `spacing` is
/// the distance between two slices. Consider parallel rays at the angle arctan(fur.sweep) to the strand, and
/// two neighbouring slices. Some of these rays hit the strand between the two slices. The points where these
/// rays cross one of the slices fill a region of exactly this area. Without the widening, rays
/// would pass between the sections of a strand if there are few layers, and the fur would look thinner and
/// darker.
double strand_radius(const FurStrand& strand, const FurScene& fur, double h);

/// Returns `count` points that are evenly distributed over [0,1)^2. The square is divided into rows of cells,
/// with nearly the same number of cells in each row. Each cell has one point at a random position.
std::vector<glm::dvec2> jittered_points(int count, std::uint32_t seed, std::uint32_t stream);

}  // namespace pelage
