// Compares a wetness mask with the reference's mask.
#pragma once
#include <glm/vec4.hpp>
#include <vector>

#include "harness/compare/check.hpp"

namespace pelage {

/// Compares two masks of texels (c_u, c_v, r, rho). The first check counts the texels that are wet in only
/// one mask (limit 0). The second check is the largest error of a value over all other texels (limit
/// tolerance::mask_texel; an error that is not finite counts as 10^6). Rounding may decide whether a texel at
/// the border of a droplet is wet; such a texel counts only in the first check. Throws std::invalid_argument
/// if the sizes differ.
std::vector<Check> check_mask(const std::vector<glm::vec4>& ours, const std::vector<glm::vec4>& reference);

}  // namespace pelage
