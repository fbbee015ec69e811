// A mapping is a way to assign pixels to work-items. Shells::tally() counts fragments with the mapping
// `pixel`, and Shells::count() with the mapping that draws the pictures. This file compares the two counts.
// It also compares the exact counts with the estimate from a random sample of pixels.
#include <gtest/gtest.h>

#include "harness/shells/opencl/shells.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"

namespace pelage {
namespace {

TEST(Tally, TwoMappingsCountTheSameAndASampleComesNear) {
  Shells shells(pictures::device(), pictures::small_frame("curling"), {});
  shells.frame();
  const Picture before = shells.read();
  const Tally exact = shells.tally(1);
  EXPECT_EQ(exact.covered, shells.count());
  EXPECT_GT(exact.blended, 0u);
  EXPECT_LE(exact.blended, exact.shaded);
  EXPECT_LT(exact.shaded, exact.covered);
  const Tally sample = shells.tally(16);
  EXPECT_NEAR(double(sample.covered) / double(exact.covered), 1, 0.1);
  EXPECT_NEAR(double(sample.shaded) / double(exact.shaded), 1, 0.1);
  EXPECT_NEAR(double(sample.blended) / double(exact.blended), 1, 0.1);
  EXPECT_EQ(compare(before, shells.read()).worst, 0) << "counting draws nothing";
}

}  // namespace
}  // namespace pelage
