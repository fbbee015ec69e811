// Tests the structural similarity of pictures against values computed from its definition.
#include <gtest/gtest.h>

#include <glm/vec3.hpp>

#include "harness/compare/metrics.hpp"
#include "harness/error.hpp"

namespace pelage {
namespace {

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

}  // namespace
}  // namespace pelage
