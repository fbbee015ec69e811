// Computes the strands that move the fur. A strand is one mass on a spring with a root and a rest position.
// Weights give the influence of the strands on each surface point. S is a paper that docs/frame.md lists.
#pragma once
#include "harness/prepare/frame_input.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage {

/// Returns one strand per triangle (S 3.2.1). The vector from the root to the tip at rest is L0 normalize(n +
/// comb t + comb_noise s). Here n is the triangle's normal, t is the comb direction, projected onto the
/// surface and smoothed, and s is a smoothly varying random tangent vector. If comb and comb_noise are 0,
/// this vector is exactly L0 n.
StrandSet make_strands(const Skin& skin, const FurScene& fur, const WindScene& wind);

/// Returns the rest tip of each surface point: the position of the point plus the weighted mean of
/// StrandSet::anchor over the triangles around the point.
std::vector<glm::vec3> rest_tips(const Skin& skin, const StrandSet& strands);

/// Returns the rest tip of the stick at each surface point: the position of the point plus `length` times the
/// normal at the point.
std::vector<glm::vec3> rest_tips(const Skin& skin, const std::vector<glm::vec3>& normal, float length);

}  // namespace pelage
