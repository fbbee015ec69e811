// Tests bytes of the fur texture: the coverage at the end of a strand, and the shade of mip levels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/prepare/fur_strands.hpp"
#include "harness/prepare/fur_texture.hpp"

namespace pelage {
namespace {

double coverage(const FurTexture& t, int layer, int x, int y) {
  const auto side = std::size_t(t.size);
  return t.level[0][(std::size_t(layer) * side + std::size_t(y)) * side + std::size_t(x)][0] / 255.0;
}

// A slice represents the slab below it. If a strand ends inside the slab, its coverage in the slice is the
// fraction of the slab's height that the strand fills.
TEST(FurTexture, AStrandThatEndsInASlabCoversItsShareOfIt) {
  FurScene fur;
  // Coverages are computed for 16 layers and converted for other numbers of layers. No conversion is needed
  // here.
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
        for (int x = 0; x < t.size; ++x) most = std::max(most, coverage(t, n, x, y));
      const double share = std::clamp(length * fur.layers - n, 0.0, 1.0);
      EXPECT_NEAR(most, share, 0.003) << "seed " << seed << ", layer " << n << ", length " << length;
      partly += share > 0.1 && share < 0.9;
    }
  }
  EXPECT_GT(partly, 5);
}

TEST(FurTexture, MipLevelsShadeByCoverage) {
  FurScene fur;
  // Coverages are computed for 16 layers and converted for other numbers of layers. No conversion is needed
  // here.
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
      // If the sum of the coverage bytes is small, their rounding errors change the weighted mean too much.
      if (sum < 100) continue;
      const double expected = weighted / sum;
      // Three kinds of bytes are rounded: the shade of level 1 (error 0.5), the shades of level 0 from which
      // `expected` is computed (error 0.5), and the coverages of level 0. The tolerance covers the sum of the
      // three errors.
      EXPECT_NEAR(t.level[1][y * side / 2 + x][1], expected, 2.5) << x << ' ' << y;
      ++tested;
      uneven += std::abs(expected - plain) > 6;
    }
  EXPECT_GT(tested, 100);
  // `uneven` is the number of texels whose mean shade weighted by coverage differs from the unweighted mean
  // shade.
  EXPECT_GT(uneven, 10);
}

}  // namespace
}  // namespace pelage
