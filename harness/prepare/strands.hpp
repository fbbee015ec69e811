// The masses on springs that move the fur: their roots, their rest positions, and their weights for surface
// points.
#pragma once
#include "harness/prepare/frame_input.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage {

/// Returns one strand per triangle (S 3.2.1). The rest tip relative to the root is
/// L0 normalize(n + comb t + comb_noise s). t is the comb direction, projected onto the surface and smoothed;
/// s is a smooth random tangent vector. If both factors are 0, it is exactly L0 n.
StrandSet make_strands(const Skin& skin, const FurScene& fur, const WindScene& wind);

/// Rest tips of the surface points: the position of a point plus the weighted mean of its strands' anchors.
std::vector<glm::vec3> rest_tips(const Skin& skin, const StrandSet& strands);

/// Rest tips of a topology's sticks: the position of a point plus `length` times its normal.
std::vector<glm::vec3> rest_tips(const Skin& skin, const std::vector<glm::vec3>& normal, float length);

}  // namespace pelage
