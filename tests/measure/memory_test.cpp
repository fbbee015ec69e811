// Tests peak_memory(): the returned peak includes memory that was freed, and is lower after
// reset_peak_memory().
#include "harness/measure/memory.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>

namespace pelage {
namespace {

constexpr std::size_t much = std::size_t(64) << 20;

TEST(PeakMemory, SeesWhatWasTakenAndGivenBack) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer keeps freed memory in its quarantine, so that the mark does not fall";
#endif
  reset_peak_memory();
  const std::uint64_t before = peak_memory();
  if (before == 0) GTEST_SKIP() << "no VmHWM here";
  {
    const auto block = std::make_unique<char[]>(much);
    std::memset(block.get(), 1, much);
    EXPECT_EQ(block[much / 2], 1);
  }
  const std::uint64_t with = peak_memory();
  EXPECT_GE(with, before + much - (much >> 3));
  reset_peak_memory();
  EXPECT_LT(peak_memory(), with);
}

}  // namespace
}  // namespace pelage
