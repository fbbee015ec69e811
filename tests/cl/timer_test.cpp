
#include <gtest/gtest.h>

#include <cstdlib>

#include "harness/cl/measure.hpp"

using namespace pelage;

namespace {

// Timestamps that a correct driver would report: three commands of 10 ms each, one after another, in 30.4 ms
// of wall time.
std::vector<cl::Stamps> honest() {
  return {{1'000, 5'000, 200'000, 10'200'000},
          {2'000, 6'000, 10'210'000, 20'210'000},
          {3'000, 7'000, 20'220'000, 30'220'000}};
}

}  // namespace

TEST(Timer, AnHonestOneIsBelieved) {
  const auto check = cl::judge_timer(1, honest(), 30.4);
  EXPECT_TRUE(check.real) << check.reason;
  EXPECT_DOUBLE_EQ(check.event_ms, 30.0);
  EXPECT_TRUE(cl::judge_timer(1000, honest(), 30.4).real);
  EXPECT_TRUE(cl::judge_timer(1, honest(), 45).real) << "launches cost something";
}

TEST(Timer, FakesAreNot) {
  const auto refused = [](std::uint64_t resolution, const std::vector<cl::Stamps>& batch, double wall) {
    const auto check = cl::judge_timer(resolution, batch, wall);
    EXPECT_NE(check.real, !check.reason.empty());
    return !check.real;
  };
  EXPECT_TRUE(refused(0, honest(), 30.4)) << "no resolution";
  EXPECT_TRUE(refused(1, {}, 30.4)) << "nothing timed";
  EXPECT_TRUE(refused(1, {{0, 1, 2, 3}, {4, 5, 6, 7}}, 30.4)) << "counts calls, as rusticl does";
  EXPECT_TRUE(refused(1, std::vector<cl::Stamps>(3), 30.4)) << "all zero";
  EXPECT_TRUE(refused(1, honest(), 300)) << "a tenth of the wall time: another unit";
  EXPECT_TRUE(refused(1, honest(), 3)) << "ten times the wall time";
  EXPECT_TRUE(refused(1, honest(), 29)) << "more than the wall time";
  for (int damage = 0; damage < 4; ++damage) {
    auto batch = honest();
    if (damage == 0) std::swap(batch[1].started, batch[1].ended);
    if (damage == 1) batch[1].ended = batch[1].started;
    if (damage == 2) batch[1].queued = batch[1].started + 1;
    if (damage == 3) batch[1].started = batch[0].started;
    EXPECT_TRUE(refused(1, batch, 30.4)) << damage;
  }
}

TEST(Timer, OfEveryDeviceIsJudged) {
  // rusticl lists its device only if RUSTICL_ENABLE is set before the first OpenCL call of the process. CTest
  // runs each test in its own process, so this process has made no OpenCL call yet.
  ::setenv("RUSTICL_ENABLE", "llvmpipe", 1);
  for (const cl::Device& device : cl::devices()) {
    const auto check = cl::check_timer(cl::Queue(device));
    EXPECT_GT(check.wall_ms, 50) << device.info().name;
    const std::string& platform = device.info().platform;
    if (platform == "Portable Computing Language" || platform == "rusticl") {
      EXPECT_EQ(check.real, platform != "rusticl") << "Mesa 22's rusticl does not measure; " << check.reason;
    }
  }
}

TEST(Measure, StaysWithinReason) {
  const auto speed = cl::measure_device(cl::choose_device(""));
  EXPECT_GT(speed.triad_gb_s, 0.1);
  EXPECT_LT(speed.triad_gb_s, 100'000);
  EXPECT_GT(speed.fma_gflop_s, 0.1);
  EXPECT_LT(speed.fma_gflop_s, 1e6);
  EXPECT_GT(speed.launch_us, 0);
  EXPECT_LT(speed.queued_launch_us, 1e5);
}
