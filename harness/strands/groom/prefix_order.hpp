// The order of strands in memory. A picture of a part of the strands draws the first ones
// (docs/strands.md, section "Level of detail").
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace pelage::strands {

/// Returns the order in which strands are stored: the indices of the strands, such that each prefix of the
/// order is spread over the surface almost as evenly as all strands, and strands that are near each other in
/// the order share key strands.
///
/// place[i] is a number from 0 to 1: the place of strand i in the random permutation of its fur layer,
/// divided by the layer's number of strands. In the permutation of scatter_roots(), each prefix is blue
/// noise. near[i] is a number that is similar for neighbouring strands, such as the number of the triangle.
/// The function sorts the strands by `place`, and cuts the sorted list into blocks. The strands of a block
/// are then sorted by `near`. A block has a sixteenth of the number of the strands before it, and at least 16
/// strands. A prefix that ends within a block therefore has at most 1/16 more strands per area on one part of
/// the surface than on the other part.
std::vector<std::uint32_t> prefix_order(std::span<const float> place, std::span<const std::uint32_t> near);

}  // namespace pelage::strands
