#include "harness/measure/sampler.hpp"

#include <gtest/gtest.h>

namespace pelage {
namespace {

/// A simulated clock. Each call of frame() advances the clock by the time of one frame, length_ms(i) for
/// frame i.
struct Clock {
  double now_s = 0;
  int frames = 0;
  std::function<double(int)> length_ms;
  FrameSample frame() {
    const double length = length_ms(frames++);
    now_s += length / 1000;
    return {length, {{"simulate", length / 4}, {"raster", length / 2}}};
  }
  Sampling run(const SamplingLimits& limits) {
    return take_samples([this] { return frame(); }, limits, [this] { return now_s; });
  }
};

TEST(Sampler, WarmsUpByTimeAndKeepsTheFirstLaunchApart) {
  Clock clock{.length_ms = [](int i) { return i == 0 ? 900.0 : i < 6 ? 50.0 : 10.0; }};
  const Sampling s = clock.run({0.25, 6, 100, 0.01, 10});
  EXPECT_EQ(s.first_launch_ms, 900);
  // The warm-up of 0.25 s consists of the five frames of 50 ms. None of them is a sample.
  EXPECT_EQ(s.samples.at("frame").wall_ms, std::vector<double>(6, 10.0));
  EXPECT_TRUE(s.converged);
}

TEST(Sampler, StopsWhenTheMedianIsKnown) {
  Clock steady{.length_ms = [](int i) { return 10 + 0.001 * (i % 3); }};
  EXPECT_EQ(steady.run({0, 8, 500, 0.01, 100}).samples.at("frame").wall_ms.size(), 8u);

  Clock noisy{.length_ms = [](int i) { return i % 2 ? 10.0 : 20.0; }};
  const Sampling s = noisy.run({0, 8, 60, 0.01, 100});
  EXPECT_EQ(s.samples.at("frame").wall_ms.size(), 60u);
  EXPECT_FALSE(s.converged);
}

TEST(Sampler, StopsAtItsWallClockLimit) {
  Clock slow{.length_ms = [](int) { return 700.0; }};
  const Sampling s = slow.run({0, 10, 100, 0.01, 2});
  EXPECT_EQ(s.samples.at("frame").wall_ms.size(), 3u);
  EXPECT_FALSE(s.converged);
}

TEST(Sampler, TakesOneSampleWhateverTheLimit) {
  Clock slow{.length_ms = [](int) { return 5000.0; }};
  EXPECT_EQ(slow.run({0, 10, 100, 0.01, 0}).samples.at("frame").wall_ms.size(), 1u);
}

TEST(Sampler, EventTimesStandInColumnsOfTheirOwn) {
  Clock clock{.length_ms = [](int) { return 8.0; }};
  const Sampling s = clock.run({0, 6, 6, 0.01, 100});
  EXPECT_EQ(s.samples.at("raster").event_ms, std::vector<double>(6, 4.0));
  EXPECT_TRUE(s.samples.at("raster").wall_ms.empty());
  EXPECT_EQ(s.samples.at("frame").event_ms, std::vector<double>(6, 6.0));
}

TEST(Sampler, CpuTimesStandBesideWallTimesWhereTheyAreTaken) {
  double now_s = 0;
  int frames = 0;
  const Sampling s = take_samples(
      [&] {
        now_s += 0.008;
        ++frames;
        return FrameSample{.wall_ms = 8,
                           .phase_wall_ms = {{"opengl", 20}},
                           .cpu_ms = 10.0 + frames,
                           .phase_cpu_ms = {{"opengl", 30}}};
      },
      {0, 6, 6, 0.01, 100}, [&] { return now_s; });
  // Frame i has the CPU time 10 + i ms. Frame 1 is the first launch and frame 2 the warm-up, so the samples
  // begin at 13 ms.
  EXPECT_EQ(s.samples.at("frame").cpu_ms, (std::vector<double>{13, 14, 15, 16, 17, 18}));
  EXPECT_EQ(s.samples.at("opengl").cpu_ms, std::vector<double>(6, 30.0));
  Clock clock{.length_ms = [](int) { return 8.0; }};
  EXPECT_TRUE(clock.run({0, 6, 6, 0.01, 100}).samples.at("frame").cpu_ms.empty());
}

}  // namespace
}  // namespace pelage
