// Tests the order of fur layers in a view.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "harness/error.hpp"
#include "harness/strands/groom/fur.hpp"
#include "harness/strands/groom/steps.hpp"

namespace pelage::strands {
namespace {

/// A camera on the z axis that looks towards -z: the view depth of a point is 5 - z.
Camera camera() {
  Camera c;
  c.row_w = {0, 0, -1, 5};
  return c;
}

/// Boxes with the given view depths of their centres. Their nearest points have another order.
std::vector<LayerBounds> boxes(const std::vector<float>& depths) {
  std::vector<LayerBounds> bounds;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const float size = 3 * depths[i];
    bounds.push_back({{-1, 2, 5 - depths[i] - size}, {1, 7, 5 - depths[i] + size}});
  }
  return bounds;
}

using Ranks = std::vector<std::uint8_t>;

Ranks ranks(const std::vector<float>& depths, std::vector<float> biases = {}, std::vector<int> offsets = {}) {
  biases.resize(depths.size());
  offsets.resize(depths.size());
  return layer_ranks(boxes(depths), camera(), biases, offsets);
}

TEST(LayerOrder, IsThatOfTheDepthsOfTheCentres) {
  EXPECT_EQ(ranks({4, 6, 5}), (Ranks{0, 2, 1}));
  EXPECT_EQ(ranks({6, 5, 4}), (Ranks{2, 1, 0}));
  EXPECT_EQ(ranks({5, 5, 4}), (Ranks{1, 2, 0})) << "equal depths: in the order of the numbers";
  EXPECT_EQ(ranks({3}), (Ranks{0}));
  EXPECT_EQ(ranks({}), (Ranks{}));
}

TEST(LayerOrder, DependsOnTheView) {
  Camera behind = camera();
  behind.row_w = {0, 0, 1, 5};
  const std::vector<float> biases(2);
  const std::vector<int> offsets(2);
  EXPECT_EQ(layer_ranks(boxes({4, 6}), camera(), biases, offsets), (Ranks{0, 1}));
  EXPECT_EQ(layer_ranks(boxes({4, 6}), behind, biases, offsets), (Ranks{1, 0}));
}

TEST(LayerOrder, ABiasIsAddedToTheDepth) {
  EXPECT_EQ(ranks({4, 6, 5}, {0.9f}), (Ranks{0, 2, 1}));
  EXPECT_EQ(ranks({4, 6, 5}, {1.1f}), (Ranks{1, 2, 0}));
  EXPECT_EQ(ranks({4, 6, 5}, {0, -2.5f, 0}), (Ranks{1, 0, 2}));
}

TEST(LayerOrder, AnOffsetMovesALayerByPlaces) {
  EXPECT_EQ(ranks({4, 5, 6, 7}, {}, {1}), (Ranks{1, 0, 2, 3}));
  EXPECT_EQ(ranks({4, 5, 6, 7}, {}, {2}), (Ranks{2, 0, 1, 3}));
  EXPECT_EQ(ranks({4, 5, 6, 7}, {}, {255}), (Ranks{3, 0, 1, 2}));
  EXPECT_EQ(ranks({4, 5, 6, 7}, {}, {0, 0, 0, -1}), (Ranks{0, 1, 3, 2}));
  EXPECT_EQ(ranks({4, 5, 6, 7}, {}, {0, 0, 0, -3}), (Ranks{1, 2, 3, 0}));
  EXPECT_EQ(ranks({4, 5, 6, 7}, {}, {0, 0, 0, -255}), (Ranks{1, 2, 3, 0}));
  EXPECT_EQ(ranks({4, 5, 6, 7}, {}, {1, -1}), (Ranks{1, 0, 2, 3})) << "the two layers change places";
  EXPECT_EQ(ranks({4, 5, 6, 7}, {}, {2, 2, 2, 2}), (Ranks{0, 1, 2, 3}));
}

TEST(LayerOrder, ListsOfOtherLengthsAreRefused) {
  const std::vector<float> biases(1);
  const std::vector<int> offsets(2);
  EXPECT_THROW(layer_ranks(boxes({4, 6}), camera(), biases, offsets), InputError);
}

// Tests the order of strands in memory.
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
