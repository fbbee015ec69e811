// Tests the order of strands in memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "harness/strands/groom/steps.hpp"

namespace pelage::strands {
namespace {

struct Input {
  std::vector<float> place;
  std::vector<std::uint32_t> near;
};

/// Strands in two fur layers with `first` and `second` strands.
Input two_layers(std::size_t first, std::size_t second) {
  Input in;
  std::mt19937 random(4);
  std::uint32_t offset = 0;
  for (const std::size_t count : {first, second}) {
    for (std::size_t i = 0; i < count; ++i) {
      in.place.push_back(float((double(i) + 0.5) / double(count)));
      in.near.push_back(offset + std::uint32_t(random() % 1000));
    }
    offset += 1000;
  }
  return in;
}

TEST(PrefixOrder, IsAPermutation) {
  for (const std::size_t count : {0u, 1u, 15u, 16u, 17u, 5000u}) {
    const Input in = two_layers(count, 3 * count);
    std::vector<std::uint32_t> order = prefix_order(in.place, in.near);
    std::sort(order.begin(), order.end());
    ASSERT_EQ(order.size(), 4 * count);
    for (std::uint32_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
  }
}

TEST(PrefixOrder, APrefixHasTheSamePartOfEachLayer) {
  const std::size_t first = 3000, second = 9000;
  const Input in = two_layers(first, second);
  const std::vector<std::uint32_t> order = prefix_order(in.place, in.near);
  std::size_t found = 0;
  for (std::size_t n = 1; n <= order.size(); ++n) {
    found += order[n - 1] < first;
    if (n < 200) continue;
    // A prefix that ends within a block has at most 1 / 16 too many strands.
    EXPECT_NEAR(double(found), 0.25 * double(n), double(n) / 16 + 8) << n;
  }
}

TEST(PrefixOrder, NeighboursInTheOrderAreNearEachOther) {
  const Input in = two_layers(40000, 40000);
  const std::vector<std::uint32_t> order = prefix_order(in.place, in.near);
  double sum = 0;
  for (std::size_t i = 1; i < order.size(); ++i)
    sum += std::abs(double(in.near[order[i]]) - double(in.near[order[i - 1]]));
  EXPECT_LT(sum / double(order.size()), 10);  // 667 for a random order
}

}  // namespace
}  // namespace pelage::strands
