#include "harness/prepare/fur_texture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace pelage {
namespace {

double coverage(const FurTexture& t, int level, int layer, int x, int y) {
  const auto side = std::size_t(t.size >> level);
  const std::size_t i = (std::size_t(layer) * side + std::size_t(y)) * side + std::size_t(x);
  return t.level[std::size_t(level)][i][0] / 255.0;
}

double mean_coverage(const FurTexture& t, int level, int layer) {
  const int side = t.size >> level;
  double sum = 0;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) sum += coverage(t, level, layer, x, y);
  return sum / side / side;
}

/// Returns fur of guard hairs without undercoat and locks. make_fur_texture() computes coverages for 16
/// layers and converts them for other numbers of layers, so the texture contains the unconverted coverages.
FurScene guard_hairs(int strands) {
  FurScene fur;
  fur.layers = 16;
  fur.strands = strands;
  fur.undercoat = 0;
  fur.locks = 0;
  return fur;
}

/// Returns one such hair, whose radius in texels is the same from root to tip.
FurScene cylinder(float radius) {
  FurScene fur = guard_hairs(1);
  fur.radius = radius;
  fur.least_length = 1;
  fur.tip_radius = 1;
  return fur;
}

double shade(const FurTexture& t, int layer, int x, int y) {
  const auto side = std::size_t(t.size);
  return t.level[0][(std::size_t(layer) * side + std::size_t(y)) * side + std::size_t(x)][1] / 127.5;
}

/// The mean brightness and the mean opacity along parallel view rays. The brightness of a fragment at height
/// h is shade * (0.5 + h/2). Fragments are blended by the source-over operator.
struct Seen {
  double light = 0, opacity = 0;
};

/// Returns the mean brightness and the mean opacity along parallel view rays. `slope` is the tangent of the
/// angle between the rays and the surface normal. `azimuth` is the direction of the rays projected onto the
/// surface, in radians.
Seen along_rays(const FurTexture& t, const FurScene& fur, double slope, double azimuth) {
  const double per_layer = slope * double(fur.length * fur.tile) * t.size / t.layers;  // texels
  Seen mean;
  for (int y = 0; y < t.size; ++y)
    for (int x = 0; x < t.size; ++x) {
      double light = 0, through = 1;
      for (int n = t.layers - 1; n >= 0; --n) {
        const double far = per_layer * (t.layers - 1 - n);
        const int i = (x + int(std::lround(far * std::cos(azimuth)))) & (t.size - 1);
        const int j = (y + int(std::lround(far * std::sin(azimuth)))) & (t.size - 1);
        const double a = coverage(t, 0, n, i, j), h = (1.0 + n) / t.layers;
        light += through * a * shade(t, n, i, j) * (0.5 + 0.5 * h);
        through *= 1 - a;
      }
      mean.light += light + through * 0.3;  // 0.3: the brightness of the skin
      mean.opacity += 1 - through;
    }
  const double texels = double(t.size) * t.size;
  return {mean.light / texels, mean.opacity / texels};
}

/// Returns the means over view directions whose angle to the strands is 0 to 63 degrees, weighted
/// approximately by the area that each angle has in the picture of a furred sphere.
Seen from_all_sides(const FurTexture& t, const FurScene& fur) {
  Seen sum;
  double weight = 0;
  for (const double slope : {0.0, 0.5, 1.0, 2.0})
    for (const double azimuth : {0.3, 2.5}) {
      // Let a be the angle between view ray and strand. In the picture of a sphere, the area with angles
      // between a and a + da is proportional to cos(a) sin(a) da. As a function of the slope s = tan(a), this
      // area is proportional to s / (1 + s^2)^2 ds. The constant 0.1 is added so that rays along the strands
      // (s = 0) have a weight above 0.
      const double shown = (slope + 0.1) / std::pow(1 + slope * slope, 2);
      const Seen seen = along_rays(t, fur, slope, azimuth);
      sum.light += shown * seen.light;
      sum.opacity += shown * seen.opacity;
      weight += shown;
    }
  return {sum.light / weight, sum.opacity / weight};
}

TEST(FurTexture, SameSceneSameBytes) {
  FurScene fur;
  fur.layers = 8;
  fur.texture = 64;
  fur.strands = 300;
  fur.undercoat = 200;
  fur.locks = 40;
  const FurTexture first = make_fur_texture(fur);
  EXPECT_TRUE(first.level == make_fur_texture(fur).level);
  fur.seed = 2;
  EXPECT_FALSE(first.level == make_fur_texture(fur).level);
}

TEST(FurTexture, HasEveryLevelOfEveryLayer) {
  FurScene fur;
  fur.layers = 3;
  fur.texture = 32;
  const FurTexture t = make_fur_texture(fur);
  ASSERT_EQ(t.level.size(), 6u);
  for (int l = 0; l < 6; ++l)
    EXPECT_EQ(t.level[std::size_t(l)].size(), std::size_t(3 * (32 >> l) * (32 >> l)));
}

TEST(FurTexture, MipLevelsKeepTheCoverage) {
  FurScene fur;
  fur.layers = 16;
  const FurTexture t = make_fur_texture(fur);
  for (const int n : {0, 7, 12})
    EXPECT_NEAR(mean_coverage(t, 3, n), mean_coverage(t, 0, n), 0.002) << "layer " << n;
}

/// In a slice, a strand is a disc. If the disc crosses the border of the square texture, it must continue at
/// the opposite border. The area of the disc then does not depend on its position.
TEST(FurTexture, WrapsAround) {
  FurScene fur = cylinder(40);
  int cut = 0;
  for (std::uint32_t seed = 0; seed < 24; ++seed) {
    fur.seed = seed;
    const FurStrand strand = grow_strands(fur).front();
    const FurTexture t = make_fur_texture(fur);
    const double area = mean_coverage(t, 0, 3) * t.size * t.size;
    const double r = strand.radius * t.size;
    EXPECT_NEAR(area, std::numbers::pi * r * r, 0.01 * area) << "seed " << seed;
    const auto [x, y] = std::pair(strand.root.x * t.size, strand.root.y * t.size);
    cut += x < r || y < r || x > t.size - r || y > t.size - r;
  }
  EXPECT_GT(cut, 5);  // number of tested discs that cross the border
}

TEST(FurTexture, SixteenAndSixtyFourLayersAreAsDenseAlongTheStrands) {
  FurScene fur;
  fur.sweep = 0;
  fur.layers = 16;
  const Seen few = along_rays(make_fur_texture(fur), fur, 0, 0);
  fur.layers = 64;
  const Seen many = along_rays(make_fur_texture(fur), fur, 0, 0);
  EXPECT_NEAR(few.light / many.light, 1.0, 0.025);
  EXPECT_NEAR(few.opacity / many.opacity, 1.0, 0.05);
  EXPECT_GT(many.opacity, 0.4);
  EXPECT_LT(many.opacity, 0.95);
}

TEST(FurTexture, SixteenAndSixtyFourLayersAreAsBrightFromAllSides) {
  for (const int locks : {0, 700}) {
    FurScene fur;
    fur.locks = locks;
    fur.layers = 16;
    const Seen few = from_all_sides(make_fur_texture(fur), fur);
    fur.layers = 64;
    const Seen many = from_all_sides(make_fur_texture(fur), fur);
    EXPECT_NEAR(few.light / many.light, 1.0, 0.025) << locks << " locks";
  }
}

/// The cross-section of a blade is an ellipse. The area of the ellipse is proportional to fur.width, and its
/// longer axis is perpendicular to the bend.
TEST(FurTexture, BladesAreWideAcrossTheirBend) {
  FurScene fur = cylinder(12);
  fur.width = 3;
  const FurStrand blade = grow_strands(fur).front();
  EXPECT_NEAR(glm::length(blade.across), 1.0, 1e-12);
  const FurTexture t = make_fur_texture(fur);
  double area = 0, along = 0, across = 0;
  for (int y = 0; y < t.size; ++y)
    for (int x = 0; x < t.size; ++x) {
      const double a = coverage(t, 0, 0, x, y);
      const glm::dvec2 from_root = (glm::dvec2(x, y) + 0.5) / double(t.size) - blade.root;
      const glm::dvec2 d = (from_root - glm::round(from_root)) * double(t.size);
      area += a;
      across += a * glm::dot(d, blade.across) * glm::dot(d, blade.across);
      along +=
          a * (d.x * blade.across.y - d.y * blade.across.x) * (d.x * blade.across.y - d.y * blade.across.x);
    }
  const double r = strand_radius(blade, fur, 1.0 / 16) * t.size;
  EXPECT_NEAR(area, 3 * std::numbers::pi * r * r, 0.01 * area);
  EXPECT_NEAR(std::sqrt(across / along), 3.0, 0.03);
}

TEST(FurStrands, SweepWidensStrandsOnlyWhereLayersAreFew) {
  FurScene fur;
  fur.sweep = 0;
  const FurStrand strand = grow_strands(fur).front();
  const double plain = strand_radius(strand, fur, 0.3);
  fur.sweep = 0.18f;
  fur.layers = 512;
  EXPECT_NEAR(strand_radius(strand, fur, 0.3) / plain, 1.0, 0.01);
  fur.layers = 16;
  EXPECT_GT(strand_radius(strand, fur, 0.3) / plain, 1.05);
}

TEST(FurTexture, ThinsOutFromRootToTip) {
  FurScene fur;
  const FurTexture t = make_fur_texture(fur);
  double before = 1;
  for (int n = 0; n < fur.layers; n += 9) {
    const double mean = mean_coverage(t, 0, n);
    EXPECT_LT(mean, before) << "layer " << n;
    before = mean;
  }
}

/// A bilinear lookup at the edge of a strand also reads empty texels, so their shade must equal the shade of
/// the strand.
TEST(FurTexture, EmptyTexelsBesideAStrandCarryItsShade) {
  const FurTexture t = make_fur_texture(guard_hairs(40));
  int tested = 0;
  for (int y = 1; y + 1 < t.size; ++y)
    for (int x = 1; x + 1 < t.size; ++x) {
      if (coverage(t, 0, 0, x, y) > 0) continue;
      double low = 9, high = -9;
      for (int k = 0; k < 9; ++k) {
        const int i = x + k % 3 - 1, j = y + k / 3 - 1;
        if (coverage(t, 0, 0, i, j) <= 0) continue;
        low = std::min(low, shade(t, 0, i, j));
        high = std::max(high, shade(t, 0, i, j));
      }
      if (high < low) continue;
      EXPECT_GE(shade(t, 0, x, y), low - 0.01);
      EXPECT_LE(shade(t, 0, x, y), high + 0.01);
      ++tested;
    }
  EXPECT_GT(tested, 100);
}

TEST(FurStrands, BladesAreExponentialCurvesOfTheirOwn) {
  FurScene fur = guard_hairs(400);
  fur.bend = 20;
  fur.bend_exponent = 3;
  fur.bend_spread = 0.5f;
  double least = 1e9, most = 0, shortest = 1, longest = 0;
  glm::dvec2 mean(0.0);
  for (const FurStrand& s : grow_strands(fur)) {
    const glm::dvec2 tip = strand_centre(s, fur, s.length) - s.root;
    const glm::dvec2 half = strand_centre(s, fur, 0.5 * s.length) - s.root;
    EXPECT_NEAR(glm::length(strand_centre(s, fur, 0) - s.root), 0, 1e-12);
    EXPECT_NEAR(glm::length(tip - s.bend), 0, 1e-12);
    // (e^(c/2) - 1) / (e^c - 1) = 1 / (e^(c/2) + 1)
    const double c = 2 * std::log(glm::length(tip) / glm::length(half) - 1);
    EXPECT_NEAR(c, s.steep, 1e-9);
    least = std::min(least, c), most = std::max(most, c);
    shortest = std::min(shortest, s.length), longest = std::max(longest, s.length);
    mean += glm::normalize(tip) / 400.0;
  }
  // The bend exponents, lengths and directions of the blades must vary over their whole ranges.
  EXPECT_NEAR(least, 1.5, 0.1);
  EXPECT_NEAR(most, 4.5, 0.1);
  EXPECT_NEAR(shortest, double(fur.least_length), 0.05);
  EXPECT_NEAR(longest, 1, 0.05);
  EXPECT_LT(glm::length(mean), 0.15);
}

TEST(FurTexture, OfBladesComesInThePapersSizes) {
  // At all texture sizes the blades are thicker than a texel. A texel stores only the coverage by the blade
  // that covers the largest part of the texel. With thinner blades, several blades could cover parts of one
  // texel, and the covered fraction would depend on the texture size.
  FurScene fur = guard_hairs(110);
  fur.locks = FurScene{}.locks;
  fur.radius = 4.5f;
  fur.taper = 0.3f;
  fur.bend = 20;
  fur.bend_spread = 0.4f;
  std::vector<double> opacity;
  for (const int size : {64, 128, 256}) {
    fur.texture = size;
    const FurTexture texture = make_fur_texture(fur);
    ASSERT_EQ(texture.size, size);
    opacity.push_back(mean_coverage(texture, 0, 2));
  }
  // The covered fraction of a slice must not depend on the texture size.
  EXPECT_NEAR(opacity[0], opacity[2], 0.12 * opacity[2]);
  EXPECT_NEAR(opacity[1], opacity[2], 0.06 * opacity[2]);
  EXPECT_GT(opacity[2], 0.02);
}

TEST(FurStrands, LocksPullTogether) {
  FurScene fur;
  fur.lock_pull = 1;
  const auto strands = grow_strands(fur);
  // With lock_pull = 1 every tip is at the centre of a lock. The 700 locks therefore allow at most 700
  // different tips for the 9000 strands.
  std::vector<glm::dvec2> places;
  for (const FurStrand& s : strands) {
    const glm::dvec2 tip = glm::fract(strand_centre(s, fur, 1.0));
    bool known = false;
    for (const glm::dvec2& p : places) {
      const glm::dvec2 d = tip - p - glm::round(tip - p);
      known = known || glm::dot(d, d) < 1e-12;
    }
    if (!known) places.push_back(tip);
  }
  EXPECT_LE(places.size(), 700u);
  EXPECT_GT(places.size(), 600u);
}

TEST(FurStrands, RootsAreEvenlySpread) {
  const auto points = jittered_points(5000, 7, 1);
  ASSERT_EQ(points.size(), 5000u);
  int count[16] = {};
  for (const glm::dvec2& p : points) {
    ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
    ++count[int(p.y * 4) * 4 + int(p.x * 4)];
  }
  for (const int c : count) EXPECT_NEAR(c, 5000 / 16.0, 25);
}

// A slice represents the slab of fur below it. A strand that ends inside the slab must have the fraction of
// the slab that it fills as its coverage.
TEST(FurTexture, AStrandThatEndsInASlabCoversItsShareOfIt) {
  FurScene fur = cylinder(12);
  fur.least_length = 0.3f;
  fur.texture = 64;
  int partly = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    fur.seed = seed;
    const double length = grow_strands(fur).front().length;
    const FurTexture t = make_fur_texture(fur);
    for (int n = 0; n < fur.layers; ++n) {
      double most = 0;
      for (int y = 0; y < t.size; ++y)
        for (int x = 0; x < t.size; ++x) most = std::max(most, coverage(t, 0, n, x, y));
      const double share = std::clamp(length * fur.layers - n, 0.0, 1.0);
      EXPECT_NEAR(most, share, 0.003) << "seed " << seed << ", layer " << n << ", length " << length;
      partly += share > 0.1 && share < 0.9;
    }
  }
  EXPECT_GT(partly, 5);
}

TEST(FurTexture, MipLevelsShadeByCoverage) {
  FurScene fur = guard_hairs(1500);
  fur.undercoat = 500;
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
