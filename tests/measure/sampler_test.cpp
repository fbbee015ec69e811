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
  Clock clock{.length_ms = [](int i) { return i == 0 ? 1000.0 : i < 5 ? 62.5 : 10.0; }};
  const Sampling s = clock.run({0.25, 6, 100, 0, 10});
  EXPECT_EQ(s.first_launch_ms, 1000);
  // The warm-up of 0.25 s consists of the four frames of 62.5 ms. None of them is a sample.
  EXPECT_EQ(clock.frames, 1 + 4 + 6);
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

TEST(Sampler, StopsAtItsWallClockLimitAfterOneSampleOrMore) {
  Clock slow{.length_ms = [](int) { return 500.0; }};
  const Sampling s = slow.run({0, 10, 100, 0.01, 2});
  EXPECT_EQ(s.samples.at("frame").wall_ms.size(), 4u);
  EXPECT_FALSE(s.converged);
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

using Samples = std::map<std::string, PhaseSamples>;

/// Returns the times of frames that have only one phase (part of a frame), "raster".
Samples samples_of(const std::vector<double>& event_ms, const std::vector<double>& wall_ms) {
  return {{"frame", {event_ms, wall_ms}}, {"raster", {event_ms, {}}}};
}

const std::vector<double> kWall{10, 11, 12, 10, 11, 12};

TEST(EventTimes, OfARealTimerAreKept) {
  EXPECT_EQ(implausible_events(samples_of({9, 10, 11, 9, 10, 11}, kWall)), "");
  EXPECT_EQ(implausible_events(samples_of({0.05, 0.1, 0.1, 0.1, 0.1, 0.2}, kWall)), "") << "a busy host";
  EXPECT_EQ(implausible_events(samples_of({}, kWall)), "");
  for (const double ms : {1e-4, 1.1}) EXPECT_EQ(implausible_events(samples_of({ms}, {1})), "") << "a limit";
  EXPECT_EQ(implausible_events(samples_of({9, 9}, {10, 11})), "") << "two equal times may be chance";
}

TEST(EventTimes, OfAFakeTimerAreRemovedAndTheReasonIsKept) {
  const std::vector<std::pair<std::vector<double>, std::string>> planted{
      {{9, 9, 9, 9, 9, 9}, "the event times of all 6 frames are equal"},
      {{0, 0, 0, 0, 0, 0}, "the median event time is 0 ms, the median wall time 11 ms"},
      {{1e-6, 2e-6, 3e-6, 1e-6, 2e-6, 3e-6}, "the median event time is 2e-06 ms, the median wall time 11 ms"},
      {{90, 91, 92, 90, 91, 92}, "the median event time is 91 ms, the median wall time 11 ms"},
      {{9, 10}, "only 2 of 6 frames have event times of the phase frame"}};
  for (const auto& [times, reason] : planted) {
    Row row;
    row.samples = samples_of(times, kWall);
    remove_implausible_events(row);
    EXPECT_EQ(row.provenance.value("event_times", ""), "left out: " + reason);
    ASSERT_EQ(row.samples.size(), 1U) << "a phase without times is no phase";
    EXPECT_EQ(row.samples.at("frame").wall_ms, kWall);
    EXPECT_TRUE(row.samples.at("frame").event_ms.empty());
  }
}

}  // namespace
}  // namespace pelage
