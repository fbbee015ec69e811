#include <algorithm>
#include <numeric>

#include "harness/strands/groom/steps.hpp"

namespace pelage::strands {
namespace {

constexpr std::size_t least_block = 16, block_part = 16;

}  // namespace

std::vector<std::uint32_t> prefix_order(std::span<const float> place, std::span<const std::uint32_t> near) {
  std::vector<std::uint32_t> order(place.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return place[a] < place[b]; });
  for (std::size_t first = 0; first < order.size();) {
    const std::size_t last = std::min(order.size(), first + std::max(least_block, first / block_part));
    std::stable_sort(order.begin() + std::ptrdiff_t(first), order.begin() + std::ptrdiff_t(last),
                     [&](std::uint32_t a, std::uint32_t b) { return near[a] < near[b]; });
    first = last;
  }
  return order;
}

}  // namespace pelage::strands
