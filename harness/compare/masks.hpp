// Compares a wetness mask with the reference's mask.
#pragma once
#include <glm/vec4.hpp>
#include <vector>

#include "harness/record/check.hpp"

namespace pelage {

/// Compares two masks. A texel holds the centre (c_u, c_v) and the radius r of a clump of wet hairs, and the
/// wetness rho. The texel is wet if rho is above 0. The first check counts the texels that are wet in only
/// one mask (limit 0). The second check limits the largest error of a value in all other texels (limit
/// tolerance::mask_texel). An error that is not finite counts as 10^6. Throws std::invalid_argument if the
/// sizes differ.
std::vector<Check> check_mask(const std::vector<glm::vec4>& ours, const std::vector<glm::vec4>& reference);

}  // namespace pelage
