#include "harness/subjects/simulation_times.hpp"

#include <gtest/gtest.h>

namespace pelage {
namespace {

TEST(SimulationTimes, TakeTheMeanOfTheTwoMiddleTimes) {
  SimulationTimes times;
  for (const double ms : {4.0, 1.0, 2.0, 9.0}) times.add({10, {{"simulate", ms}}});
  Row row;
  times.describe(row, 1000);
  EXPECT_EQ(row.metrics.at("simulate_ns_per_segment").value, 1e6 * 3 / 1000);
}

}  // namespace
}  // namespace pelage
