// Tests the coverages and shades that the fur texture stores: the coverage at the end of a strand, and the
// shades in the mip levels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/prepare/fur_strands.hpp"
#include "harness/prepare/fur_texture.hpp"

namespace pelage {
namespace {

double slice_coverage(const FurTexture& t, int layer, int x, int y) {
  const auto side = std::size_t(t.size);
  return t.level[0][(std::size_t(layer) * side + std::size_t(y)) * side + std::size_t(x)][0] / 255.0;
}

// A slice of the fur texture represents the slab of fur between this slice and the next lower slice. A strand
// may end inside the slab and fill only a fraction of its height. The coverage of the strand in the slice
// must be this fraction.
TEST(FurTexture, AStrandThatEndsInASlabCoversItsShareOfIt) {
  FurScene fur;
  // make_fur_texture() computes coverages for 16 layers, and converts them for other numbers of layers. With
  // 16 layers the texture contains the unconverted coverages.
  fur.layers = 16;
  fur.strands = 1;
  fur.undercoat = 0;
  fur.locks = 0;
  fur.radius = 12;
  fur.least_length = 0.3f;
  fur.tip_radius = 1;
  fur.texture = 64;
  int partly = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    fur.seed = seed;
    const double length = grow_strands(fur).front().length;
    const FurTexture t = make_fur_texture(fur);
    for (int n = 0; n < fur.layers; ++n) {
      double most = 0;
      for (int y = 0; y < t.size; ++y)
        for (int x = 0; x < t.size; ++x) most = std::max(most, slice_coverage(t, n, x, y));
      const double share = std::clamp(length * fur.layers - n, 0.0, 1.0);
      EXPECT_NEAR(most, share, 0.003) << "seed " << seed << ", layer " << n << ", length " << length;
      partly += share > 0.1 && share < 0.9;
    }
  }
  EXPECT_GT(partly, 5);
}

TEST(FurTexture, MipLevelsShadeByCoverage) {
  FurScene fur;
  // make_fur_texture() computes coverages for 16 layers, and converts them for other numbers of layers. With
  // 16 layers the texture contains the unconverted coverages.
  fur.layers = 16;
  fur.strands = 1500;
  fur.undercoat = 500;
  fur.locks = 0;
  fur.texture = 128;
  const FurTexture t = make_fur_texture(fur);
  const auto side = std::size_t(t.size);
  int tested = 0, uneven = 0;
  for (std::size_t y = 0; y < side / 2; ++y)
    for (std::size_t x = 0; x < side / 2; ++x) {
      double sum = 0, weighted = 0, plain = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto& texel = t.level[0][(2 * y + k / 2) * side + 2 * x + k % 2];
        sum += texel[0];
        weighted += double(texel[0]) * texel[1];
        plain += 0.25 * texel[1];
      }
      // The test skips texels with a small sum of the coverages, because the rounding errors of the coverages
      // would change the weighted mean too much.
      if (sum < 100) continue;
      const double expected = weighted / sum;
      // The tolerance covers the sum of three rounding errors: the error of the shade in level 1 (0.5), the
      // error of the shades in level 0 (0.5), and the error of the coverages in level 0.
      EXPECT_NEAR(t.level[1][y * side / 2 + x][1], expected, 2.5) << x << ' ' << y;
      ++tested;
      uneven += std::abs(expected - plain) > 6;
    }
  EXPECT_GT(tested, 100);
  // `uneven` counts the texels where the coverage-weighted mean of the shades differs clearly from the
  // unweighted mean. Only these texels show that the mip levels use the weights.
  EXPECT_GT(uneven, 10);
}

}  // namespace
}  // namespace pelage
