// The masses on springs that lead the fur: where they stand, where they rest, and which points they move.
#pragma once
#include "harness/prepare/frame_input.hpp"
#include "harness/prepare/skin.hpp"

namespace pelage {

/// One strand per triangle (S 3.2.1). Its rest tip is L0 normalize(n + comb t + comb_noise s): t the comb
/// direction made tangential and smoothed over the surface, s a smooth random tangent. Without combing it is
/// L0 n exactly.
StrandSet make_strands(const Skin& skin, const FurScene& fur, const WindScene& wind);

/// Rest tips of the surface points: position plus the weighted mean of its strands' anchors.
std::vector<glm::vec3> rest_tips(const Skin& skin, const StrandSet& strands);

/// Those of a topology's sticks, `length` along the normals.
std::vector<glm::vec3> rest_tips(const Skin& skin, const std::vector<glm::vec3>& normal, float length);

}  // namespace pelage
