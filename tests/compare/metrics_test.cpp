// Tests the counts of flipped pixels, what within() accepts, and the structural similarity of pictures.
#include "harness/compare/metrics.hpp"

#include <gtest/gtest.h>

#include <glm/vec3.hpp>
#include <limits>
#include <map>
#include <random>
#include <string>

#include "harness/compare/checks.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "harness/record/contradiction.hpp"

namespace pelage {
namespace {

/// Returns a picture of random colours in which every pixel is fur.
Picture furry(int width, int height) {
  Picture picture{width, height, {}};
  std::mt19937 random(3);
  const auto channel = [&] { return float(random() % 1000) / 1000; };
  for (int i = 0; i < width * height; ++i) picture.pixel.emplace_back(channel(), channel(), channel(), 1.0f);
  return picture;
}

/// Simulates rounding errors: adds `by` to red and blue, and subtracts `by` from green.
Picture rounded(Picture picture, float by) {
  for (glm::vec4& pixel : picture.pixel) pixel += glm::vec4(by, -by, by, 0);
  return picture;
}

std::string broken(const Agreement& agreement) {
  std::string names;
  for (const Check& check : picture_checks("reference", agreement))
    if (!check.holds()) names += check.metric + " ";
  return names;
}

// A change of one pixel by 0.4 must fail, and a change by 0.1 must pass.
TEST(Flips, OneOfASmallPicture) {
  const Picture reference = furry(160, 100);
  Picture ours = rounded(reference, 1e-5f);
  const Agreement before = compare(ours, reference);
  EXPECT_EQ(before.flips, 0u);
  EXPECT_EQ(before.psnr, before.psnr_without_flips);
  EXPECT_TRUE(within(before));

  ours.at(80, 50).x += 0.4f;
  const Agreement after = compare(ours, reference);
  EXPECT_EQ(after.flips, 1u);
  EXPECT_LT(after.psnr, before.psnr - 40);
  EXPECT_NEAR(after.psnr_without_flips, before.psnr, 0.1);
  EXPECT_EQ(broken(after), "psnr ");
  EXPECT_FALSE(within(after));

  ours.at(80, 50).x -= 0.3f;
  EXPECT_EQ(broken(compare(ours, reference)), "") << "a flip of 0.1 leaves 66 dB";
}

// At most one pixel in a thousand may be flipped. This limit is equivalent to the condition that the 99.9th
// percentile of the differences is at most tolerance::flip.
TEST(Flips, AreTheRuleOfThePercentile) {
  for (const int pixels : {1, 2, 999, 1000, 1001, 1999, 2000, 2001, 15001, 16384, 100000}) {
    const Picture reference = furry(pixels, 1);
    for (const int flips : {0, pixels / 1000, pixels / 1000 + 1, pixels}) {
      Picture ours = reference;
      for (int i = 0; i < flips; ++i) ours.pixel[std::size_t(i)].y += 3.0f / 255;
      const Agreement found = compare(ours, reference);
      EXPECT_EQ(found.flips, std::size_t(flips));
      EXPECT_EQ(found.flip_share() <= tolerance::flip_share, found.p999 <= tolerance::flip)
          << flips << " of " << pixels;
      EXPECT_EQ(found.flip_share() <= tolerance::flip_share, flips * 1000 <= pixels);
    }
  }
}

// A pixel is flipped if it differs by more than 2/255. A picture with too many flipped pixels fails, even if
// each of them differs by only 3/255 and the PSNR of the picture is sufficient.
TEST(Flips, TooManySmallOnesFail) {
  const Picture reference = furry(200, 100);
  Picture ours = rounded(reference, 1e-5f);
  for (std::size_t i = 0; i < 21; ++i) ours.pixel[900 * i].z += 3.0f / 255;
  const Agreement found = compare(ours, reference);
  EXPECT_GT(found.psnr, tolerance::picture_psnr);
  EXPECT_EQ(broken(found), "p99.9 flips ");
  EXPECT_FALSE(within(found));
}

TEST(Flips, AnyChannelAndAnythingThatIsNoNumberCounts) {
  const Picture reference = furry(4, 1);
  Picture ours = reference;
  ours.pixel[0].w = 0.98f;
  ours.pixel[1].x = std::numeric_limits<float>::quiet_NaN();
  ours.pixel[2].y += 1.9f / 255;
  EXPECT_EQ(compare(ours, reference).flips, 2u);
  EXPECT_GT(compare(ours, reference).psnr_without_flips, 40);
  for (glm::vec4& pixel : ours.pixel) pixel.w = 0.5f;
  EXPECT_EQ(compare(ours, reference).flips, 4u);
  EXPECT_EQ(compare(ours, reference).psnr_without_flips, 0) << "of no pixels";
}

/// A grey picture of 8 x 8 pixels, that is, of one window. `value` returns the grey of a pixel.
template <class Value>
Picture grey(const Value& value, float alpha = 1.0f) {
  Picture p{8, 8, std::vector<glm::vec4>(64)};
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) p.at(x, y) = glm::vec4(glm::vec3(float(value(x, y))), alpha);
  return p;
}

constexpr double c1 = 1e-4, c2 = 9e-4;

TEST(Ssim, OfEqualPicturesIsOne) {
  const Picture p = grey([](int x, int y) { return 0.1 * x + 0.01 * y; });
  EXPECT_NEAR(ssim(p, p), 1, 1e-12);
}

TEST(Ssim, OfConstantPicturesComparesTheMeans) {
  const Picture a = grey([](int, int) { return 0.25; }), b = grey([](int, int) { return 0.5; });
  EXPECT_NEAR(ssim(a, b), (2 * 0.25 * 0.5 + c1) / (0.25 * 0.25 + 0.5 * 0.5 + c1), 1e-6);
}

TEST(Ssim, OfAPictureAndItsNegativeIsBelowZero) {
  // Columns alternate between two greys: mean 0.5, variance 0.04, covariance with the negative -0.04.
  const Picture a = grey([](int x, int) { return x % 2 ? 0.7 : 0.3; });
  const Picture b = grey([](int x, int) { return x % 2 ? 0.3 : 0.7; });
  EXPECT_NEAR(ssim(a, b), (-0.08 + c2) / (0.08 + c2), 1e-5);
}

TEST(Ssim, LeavesOutWindowsWithoutFur) {
  const Picture a = grey([](int, int) { return 0.25; }, 0), b = grey([](int, int) { return 0.5; }, 0);
  EXPECT_EQ(ssim(a, b), 1);
}

TEST(Ssim, RefusesPicturesOfDifferentSizes) {
  const Picture a = grey([](int, int) { return 0.5; });
  const Picture b{4, 16, std::vector<glm::vec4>(64)};
  EXPECT_THROW(ssim(a, b), InputError);
}

// The rows of results may have only checks whose limits some version of pelage has used.
TEST(WeakestLimits, AreThoseOfTheTolerances) {
  const std::map<std::string, double> tolerances{
      {"psnr", tolerance::other_filter_psnr}, {"p99.9", tolerance::flip}, {"flips", tolerance::flip_share}};
  ASSERT_EQ(weakest_limits.size(), tolerances.size());
  for (const WeakestLimit& weakest : weakest_limits)
    EXPECT_EQ(weakest.limit, tolerances.at(weakest.metric)) << weakest.metric;
}

}  // namespace
}  // namespace pelage
