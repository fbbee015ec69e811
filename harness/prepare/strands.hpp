// Computes the strands that move the fur. A strand has a root, a rest position, and one mass on a spring.
// Weights give the influence of the strands on each surface point.
#pragma once
#include "harness/prepare/frame_input.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage {

/// Returns one strand per triangle (S 3.2.1). L0 is the length of the fur, n is the normal of the triangle,
/// and the tangent vector a is the tilt of the strand. The vector from the root to the tip at rest is L0
/// normalize(n + a). The key fur.comb tilts the strands towards the comb direction, and fur.comb_noise adds a
/// smoothly varying random tilt. If both keys are 0, the vector from the root to the tip is exactly L0 n. The
/// maps of `style` multiply L0 and fur.comb.
StrandSet make_strands(const Skin& skin, const FurScene& fur, const WindScene& wind, const Style& style = {});

/// Returns the tip of the fur at rest for each surface point. The tip is the position of the point plus a
/// weighted mean of the vectors StrandSet::anchor of the triangles around the point.
std::vector<glm::vec3> rest_tips(const Skin& skin, const StrandSet& strands);

/// Returns, for each surface point, the tip of its stick at rest: the position of the point plus `length`
/// times the normal at the point. In a mass-spring topology, sticks replace the strands.
std::vector<glm::vec3> rest_tips(const Skin& skin, const std::vector<glm::vec3>& normal, float length);

}  // namespace pelage
