#include "harness/measure/event_times.hpp"

#include <gtest/gtest.h>

namespace pelage {
namespace {

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
  EXPECT_EQ(implausible_events({}), "");
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
