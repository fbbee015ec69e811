// Compares texture lookups with values that are known from the texels (docs/shells.md, section 6).
#include "harness/shells/reference/textures.hpp"

#include <gtest/gtest.h>

namespace pelage {
namespace {

using namespace reference;

FurTexture two_levels() {
  FurTexture fur{2, 2, {}};
  fur.level.push_back({{0, 51}, {255, 102}, {51, 153}, {102, 204}, {1, 1}, {2, 2}, {3, 3}, {4, 4}});
  fur.level.push_back({{100, 128}, {200, 10}});
  return fur;
}

TEST(ReferenceTextures, TexelCentresReturnTheirTexel) {
  const FurTexture fur = two_levels();
  EXPECT_NEAR(sample_fur(fur, {.75, .25}, 0, 0, 1).coverage, 1, 1e-12);
  EXPECT_NEAR(sample_fur(fur, {.75, .25}, 0, 0, 1).shade, 102 / 127.5, 1e-12);
  EXPECT_NEAR(sample_fur(fur, {.25, .75}, 0, 0, 1).coverage, 51 / 255.0, 1e-12);  // rows increase with v
  EXPECT_NEAR(sample_fur(fur, {.75, .75}, 1, 0, 1).coverage, 4 / 255.0,
              1e-12);                                                       // no filtering between slices
  EXPECT_NEAR(sample_fur(fur, {3.75, -1.75}, 0, 0, 1).coverage, 1, 1e-12);  // the texture repeats
}

TEST(ReferenceTextures, BetweenThemTheyAreBilinearAcrossTheBorderToo) {
  const FurTexture fur = two_levels();
  EXPECT_NEAR(sample_fur(fur, {.5, .5}, 0, 0, 1).coverage, (0 + 255 + 51 + 102) / 4.0 / 255.0, 1e-12);
  EXPECT_NEAR(sample_fur(fur, {0, .25}, 0, 0, 1).coverage, .5, 1e-12);
  EXPECT_NEAR(sample_fur(fur, {.375, .25}, 0, 0, 1).coverage, .25, 1e-12);
}

TEST(ReferenceTextures, LevelsBlendLinearlyAndAreClamped) {
  const FurTexture fur = two_levels();
  EXPECT_NEAR(sample_fur(fur, {.75, .25}, 0, 1, 1).coverage, 100 / 255.0, 1e-12);
  EXPECT_NEAR(sample_fur(fur, {.75, .25}, 0, .25, 1).coverage, (.75 * 255 + .25 * 100) / 255, 1e-12);
  EXPECT_NEAR(sample_fur(fur, {.75, .25}, 0, -3, 1).coverage, 1, 1e-12);
  EXPECT_NEAR(sample_fur(fur, {.75, .25}, 1, 9, 1).coverage, 200 / 255.0, 1e-12);
}

// Two layers of the corrected coverage are as opaque as one layer of the coverage.
TEST(ReferenceTextures, CoverageIsCorrectedAfterTheLookup) {
  const FurTexture fur = two_levels();
  const FurSample whole = sample_fur(fur, {.375, .25}, 0, 0, 1),
                  half = sample_fur(fur, {.375, .25}, 0, 0, .5);
  EXPECT_NEAR((1 - half.coverage) * (1 - half.coverage), 1 - whole.coverage, 1e-12);
  EXPECT_EQ(half.shade, whole.shade);
  EXPECT_EQ(sample_fur(fur, {.75, .25}, 0, 0, .5).coverage, 1);
}

TEST(ReferenceTextures, TheCoatIsBilinear) {
  const CoatTexture coat{2, {{255, 0, 51, 9}, {0, 0, 102, 9}, {255, 255, 0, 9}, {0, 255, 0, 9}}};
  const glm::dvec3 texel = sample_coat(coat, {.25, .25}), middle = sample_coat(coat, {1.5, .5});
  EXPECT_NEAR(texel.x, 1, 1e-12);
  EXPECT_NEAR(texel.z, .2, 1e-12);
  EXPECT_NEAR(middle.x, .5, 1e-12);
  EXPECT_NEAR(middle.y, .5, 1e-12);
  EXPECT_NEAR(middle.z, .15, 1e-12);
}

}  // namespace
}  // namespace pelage
