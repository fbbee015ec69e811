// Tests the order of fur layers in a view.
#include <gtest/gtest.h>

#include "harness/error.hpp"
#include "harness/strands/groom/fur.hpp"

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

}  // namespace
}  // namespace pelage::strands
