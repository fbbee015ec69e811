// A wetness mask against the reference's.
#pragma once
#include <glm/vec4.hpp>
#include <vector>

#include "harness/compare/check.hpp"

namespace pelage {

/// Masks of texels (c_u, c_v, r, rho): how many texels are wet in one mask only (limit 0), and the largest
/// error of a value of the others (tolerance::mask_texel; one that is not finite counts as 10^6). A texel on
/// a droplet's border may fall either way; it counts in the first check only. Throws std::invalid_argument
/// where the sizes differ.
std::vector<Check> check_mask(const std::vector<glm::vec4>& ours, const std::vector<glm::vec4>& reference);

}  // namespace pelage
