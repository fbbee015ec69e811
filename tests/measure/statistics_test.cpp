#include "harness/measure/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <random>

namespace pelage {
namespace {

// The expected 95% intervals of the median of 6, 10, 20 and 30 values come from the tables of the sign test
// in Conover, Practical Nonparametric Statistics. For example, the interval of 10 sorted values runs from the
// 2nd to the 9th value. The other ranks come from an earlier implementation without Boost.Math. With other
// ranks, the intervals of recorded results would change.
TEST(Statistics, OrderStatistics) {
  const std::map<int, int> lows{{6, 1},   {7, 1},   {10, 2},   {20, 6},    {25, 8},
                                {30, 10}, {40, 14}, {100, 40}, {500, 228}, {5000, 2431}};
  for (const auto& [n, low] : lows) {
    std::vector<double> v(std::size_t(n), 0);
    std::iota(v.rbegin(), v.rend(), 1);
    const Interval interval = median_interval(v);
    EXPECT_EQ(interval.low, low) << n;
    EXPECT_EQ(interval.high, n + 1 - low) << n;
  }
}

TEST(Statistics, FiveValuesHaveNoNinetyFivePercentInterval) {
  EXPECT_FALSE(has_median_interval(5));
  EXPECT_TRUE(has_median_interval(6));
  EXPECT_TRUE(has_median_interval(3, 0.75)) << "the range of three values misses with exactly 2 / 8";
  const Interval interval = median_interval(std::vector<double>{5, 1, 4, 2, 3});
  EXPECT_EQ(interval.low, 1);
  EXPECT_EQ(interval.high, 5);
}

TEST(Statistics, IntervalHoldsTheMedianAsOftenAsItSays) {
  std::mt19937_64 random(7);
  std::exponential_distribution<double> skewed(1.0);
  const double truth = std::log(2.0);
  int held = 0;
  const int trials = 4000;
  for (int t = 0; t < trials; ++t) {
    std::vector<double> v(25);
    for (double& x : v) x = skewed(random);
    const Interval interval = median_interval(v);
    held += interval.low <= truth && truth <= interval.high;
  }
  // For n = 25 the interval from the 8th to the 18th value has a confidence of 95.7%. The test's lower limit
  // of 94.7% is three standard errors below this confidence.
  EXPECT_GE(held, int(trials * 0.947));
  EXPECT_LE(held, int(trials * 0.970));
}

TEST(Statistics, ProcessesAreResampledFirst) {
  // Two processes have a median of 10, and two have a median of 20. Resampling only the samples would give a
  // narrow interval. Resampling the processes must give a wide interval.
  std::vector<std::vector<double>> processes(4);
  for (int i = 0; i < 50; ++i)
    for (std::size_t p = 0; p < 4; ++p) processes[p].push_back((p % 2 ? 20 : 10) + 0.001 * i);
  const Interval interval = nested_median_interval(processes, 1);
  EXPECT_LT(interval.low, 10.1);
  EXPECT_GT(interval.high, 19.9);
  const Interval again = nested_median_interval(processes, 1);
  EXPECT_EQ(interval.low, again.low);
  EXPECT_EQ(interval.high, again.high);
}

TEST(Statistics, RelativeHalfWidth) {
  EXPECT_DOUBLE_EQ(relative_half_width(std::vector<double>{10, 10, 10, 10, 10, 10}), 0);
  EXPECT_DOUBLE_EQ(relative_half_width(std::vector<double>{9, 10, 10, 10, 10, 11}), 0.1);
}

TEST(Statistics, IntervalOfTheMeanOfSeparateRuns) {
  // For the first group of the data set `sleep`, R's t.test prints the interval -0.5297804 to 2.0297804.
  const std::vector<double> v{0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
  EXPECT_NEAR(mean_interval(v).low, -0.5297804, 5e-8);
  EXPECT_NEAR(mean_interval(v).high, 2.0297804, 5e-8);
  std::vector<double> positive;
  positive.reserve(v.size());
  for (const double x : v) positive.push_back(std::exp(x));
  EXPECT_NEAR(std::log(mean_interval(positive).low), -0.5297804, 5e-8);
  // 4.302653 is the quantile of Student's t for two degrees of freedom. The logarithm of 0 is no number.
  EXPECT_NEAR(mean_interval(std::vector<double>{0, 1, 2}).low, 1 - 4.302653 / std::sqrt(3.0), 1e-6);
  EXPECT_FALSE(has_mean_interval(2));
}

TEST(Statistics, DriftOfALineAndOfNoise) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> noise(0, 0.01);
  std::vector<double> line, level;
  for (int i = 0; i < 100; ++i) {
    line.push_back(10 * (1 + 0.1 * i / 99 + noise(random)));
    level.push_back(10 * (1 + noise(random)));
  }
  EXPECT_NEAR(drift_of(line).change, 0.1 / 1.05, 0.01);
  EXPECT_LT(drift_of(line).p, 1e-6);
  EXPECT_TRUE(drifts(drift_of(line)));
  EXPECT_FALSE(drifts(drift_of(level)));
  EXPECT_GT(drift_of(level).p, 0.01);
  EXPECT_EQ(drift_of(std::vector<double>(50, 3.0)).p, 1);                   // all times are equal
  EXPECT_EQ(drift_of(std::vector<double>{1, 2, 3, 4, 5, 6, 7}).change, 0);  // too few times
  for (const Drift& none : {Drift{0.02, 0}, Drift{1, 0.01}}) EXPECT_FALSE(drifts(none)) << none.change;
}

// For the values 1 to 10 in rising order, Kendall's S is 45 and its variance is 125. R's cor.test(exact =
// FALSE, continuity = TRUE) prints p = 8.303e-05.
TEST(Statistics, DriftHasThePValueOfKendall) {
  std::vector<double> v(10);
  std::iota(v.begin(), v.end(), 1.0);
  EXPECT_NEAR(drift_of(v).p, 8.303e-05, 5e-8);
  // With ties, S is 16 and its variance 48. The median slope is 1 / 6, the median 3 / 2.
  const Drift ties = drift_of(std::vector<double>{1, 1, 1, 1, 2, 2, 2, 2});
  EXPECT_NEAR(ties.p, std::erfc(15 / std::sqrt(96.0)), 1e-9);
  EXPECT_NEAR(ties.change, 7.0 / 9, 1e-9);
  v.assign(800, 1);  // of which 400 are used: every second one
  for (std::size_t i = 1; i < v.size(); i += 2) v[i] = 2;
  EXPECT_EQ(drift_of(v).p, 1);
}

}  // namespace
}  // namespace pelage
