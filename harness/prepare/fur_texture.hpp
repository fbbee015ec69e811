// Generates the fur volume texture: hairs intersected with N parallel planes (section 3.1 of S; see
// docs/shells.md).
#pragma once
#include <glm/vec2.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/scene/scene.hpp"

namespace pelage {

/// Generates `fur.strands` guard hairs and `fur.undercoat` short hairs on a repeating square. Each hair is
/// displaced towards the centre of the nearest lock of hair, and bent. The hairs are then intersected with N
/// planes, where N is fur.layers. The height of plane n, for n from 0 to N-1, is (1+n)/N times the length of
/// the fur. The same parameters give the same bytes on every machine.
///
/// Let a be the greatest coverage of a texel by a single strand, computed from 16 sub-samples. The texel
/// stores the coverage 1 - (1-a)^p with p = 16/N, so that the opacity along a ray hardly depends on N. If
/// `fur.layer_correction` is "fragment", the texel stores a, and coverage_power() is p. The shade of a
/// hair is a random value between 1 - `fur.shade` and 1 + `fur.shade`. Empty texels have the shade of
/// neighbouring strands, so that bilinear interpolation at the edge of a strand keeps the strand's shade.
FurTexture make_fur_texture(const FurScene& fur);

/// Returns the exponent p by which a coverage c from the texture is corrected after the lookup: it becomes
/// 1 - (1-c)^p. p is 1 if the texels are corrected.
double coverage_power(const FurScene& fur);

/// One hair of the square texture, which repeats over the surface. Lengths in the texture's plane are
/// fractions of the square's side. L0 is the length of the fur.
struct FurStrand {
  glm::dvec2 root{0};       ///< position of the root in the square, in [0,1)^2
  glm::dvec2 pull{0};       ///< displacement of the hair at height L0, towards the centre of its lock
  glm::dvec2 bend{0};       ///< sideways displacement of the tip of a bent hair
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

/// Returns the centre of the strand's cross-section at the height h * L0. L0 is the length of the fur, and h
/// is 0..1. The centre may lie outside the unit square.
glm::dvec2 strand_centre(const FurStrand& strand, const FurScene& fur, double h);

/// Returns the radius with which the texture shows the strand at the height h * L0, h <= length. Let r be the
/// radius of the hair at this height. It decreases from the root to the tip, where it is fur.tip_radius times
/// the radius at the root. The function returns the radius of a larger disc. The area of the disc is
/// pi r^2 + 2 r * spacing * fur.sweep, where `spacing` is the distance between two neighbouring slices. A
/// segment of the strand between two slices casts a shadow of this area on a slice, if the light rays are at
/// the angle arctan(fur.sweep) to the strand. If the discs had the radius r and the layers were few, view
/// rays would pass between the discs of a strand. The fur would then look thinner and darker.
double strand_radius(const FurStrand& strand, const FurScene& fur, double h);

/// Returns `count` points that are evenly distributed over [0,1)^2. The square is divided into rows of cells,
/// with nearly the same number of cells in each row. Each cell has one point at a random position.
std::vector<glm::dvec2> jittered_points(int count, std::uint32_t seed, std::uint32_t stream);

}  // namespace pelage
