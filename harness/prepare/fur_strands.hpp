// Where the strands of the fur texture stand, and what each is like.
#pragma once
#include <glm/vec2.hpp>
#include <vector>

#include "harness/scene/scene.hpp"

namespace pelage {

/// One hair of the repeating square. Lengths in the plane are in sides of the square.
struct FurStrand {
  glm::dvec2 root{0};       ///< in [0,1)^2
  glm::dvec2 pull{0};       ///< from the root to where a full lock would bring the tip
  glm::dvec2 bend{0};       ///< offset of a blade's tip
  double steep = 2.5;       ///< c of the exponential curve that leads there
  double length = 1;        ///< fraction of L0
  double radius = 0;        ///< at the root
  double width = 1;         ///< a blade is so many times as wide ...
  glm::dvec2 across{0, 1};  ///< ... this way (unit), across its bend
  double shade = 1;         ///< factor on the coat's colour
};

/// Guard hairs first, then the undercoat. Roots lie on a jittered grid that wraps around.
std::vector<FurStrand> grow_strands(const FurScene& fur);

/// Centre of a strand's section at height h in [0,1] (fraction of L0), not wrapped.
glm::dvec2 strand_centre(const FurStrand& strand, const FurScene& fur, double h);

/// Its radius at h <= length: full at the root, fur.tip_radius of it at the tip; and then that of the disc as
/// large as the area it sweeps when a slanting ray carries it over a slice's thickness, pi r^2 + 2 r spacing
/// fur.sweep. Without this, rays pass between the sections of a strand where layers are few, and the fur is
/// thinner and darker.
double strand_radius(const FurStrand& strand, const FurScene& fur, double h);

/// `count` points spread evenly over [0,1)^2: rows of nearly equal number, each point jittered in its cell.
std::vector<glm::dvec2> jittered_points(int count, std::uint32_t seed, std::uint32_t stream);

}  // namespace pelage
