// Tests the kernels' code for processors without AVX-512 and for compilers without Clang's builtins. Build
// options (kernels/dialect.clh) select this code, so the test also works on a machine with AVX-512 and Clang.
#include <gtest/gtest.h>

#include "tests/shells/opencl/picture_scenes.hpp"

namespace pelage {
namespace {

struct Forms : testing::TestWithParam<const char*> {};

TEST_P(Forms, LookLikeTheReference) {
  const cl::Device device = pictures::device();
  if (device.info().lanes != 16) GTEST_SKIP() << "the kernels have these forms at 16 lanes only";
  for (const char* shading : {"curling", "wet"}) {
    const auto input = pictures::small_frame(shading);
    // This tuning entry becomes a build option of the kernels, which selects the code to test.
    Shells shells(device, input, {"tile", {{GetParam(), 1}}});
    shells.advance(pictures::frames - 1);
    shells.frame();
    EXPECT_TRUE(pictures::same(pictures::drawn_by_reference(*input), shells.read(), 5000)) << shading;
  }
}

INSTANTIATE_TEST_SUITE_P(SixteenLanes, Forms, testing::Values("NO_AVX512", "NO_BUILTINS"),
                         [](const auto& given) { return std::string(given.param); });

}  // namespace
}  // namespace pelage
