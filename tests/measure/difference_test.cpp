// Tests the statistical test of `pelage compare`. Its p-values must agree with those of R. In simulations,
// its error rate must not exceed `alpha` by more than the random error of the simulation.
#include "harness/measure/difference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pelage {
namespace {

/// Returns the timings of several processes. Each value in `logs` is the logarithm of the only sample of one
/// process.
Timings timings_of(const std::vector<double>& logs, double first_start, double interval) {
  Timings timings;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    timings.processes.push_back({std::exp(logs[i])});
    timings.started_s.push_back(first_start + interval * double(i));
  }
  return timings;
}

double p_of(const Difference& difference) {
  return decide(std::span(&difference, 1), 0, 0.05).front().p;
}

// The data set `sleep` of R. The next two tests expect the values that R's t.test(extra ~ group) prints
// without and with paired = TRUE.
const std::vector<double> first{0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
const std::vector<double> second{1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};

TEST(Difference, IsWelchsTestForSeparateRuns) {
  const Difference d = difference_of(timings_of(first, 0, 1), timings_of(second, 100, 1));
  EXPECT_FALSE(d.paired);
  EXPECT_NEAR(d.log_ratio, 1.58, 1e-12);
  EXPECT_NEAR(d.degrees, 17.776, 5e-4);
  EXPECT_NEAR(p_of(d), 0.07939, 5e-6);
  const Interval ratio = ratio_interval(d, 0.95);
  EXPECT_NEAR(std::log(ratio.low), -0.2054832, 5e-7);
  EXPECT_NEAR(std::log(ratio.high), 3.3654832, 5e-7);
  const Difference equal = difference_of(timings_of({0, 0, 0}, 0, 1), timings_of({0, 0, 0}, 100, 1));
  EXPECT_FALSE(equal.assumed);
  EXPECT_TRUE(std::isinf(equal.degrees));
}

TEST(Difference, IsThePairedTestForProcessesThatTakeTurns) {
  const Difference d = difference_of(timings_of(first, 0, 2), timings_of(second, 1, 2));
  EXPECT_TRUE(d.paired && !d.assumed);
  EXPECT_EQ(d.degrees, 9);
  EXPECT_TRUE(difference_of(timings_of({1, 2, 3}, 0, 2), timings_of({2, 4, 5}, 1, 2)).paired);
  EXPECT_NEAR(p_of(d), 0.002833, 5e-7);
  Timings swapped = timings_of(second, 1, 2);
  swapped.started_s[3] -= 1.5;  // now `second` starts before `first` in the fourth pair
  EXPECT_EQ(p_of(difference_of(timings_of(first, 0, 2), swapped)), p_of(d));
  swapped.started_s[3] += 3;
  EXPECT_FALSE(difference_of(timings_of(first, 0, 2), swapped).paired);
  EXPECT_FALSE(difference_of({timings_of(first, 0, 2).processes}, timings_of(second, 1, 2)).paired);
}

TEST(Difference, AssumesASpreadWithFewProcesses) {
  const Timings one{{{9, 10, 10, 10, 10, 11}}}, other{{{11, 11, 11, 11, 11, 11, 11, 11}}};
  const Difference d = difference_of(one, other);
  EXPECT_TRUE(d.assumed);
  EXPECT_NEAR(d.log_ratio, std::log(1.1), 1e-12);
  EXPECT_NEAR(d.error, std::hypot(std::sqrt(2.0) * assumed_spread, 0.2 / 3.92), 1e-12);
  EXPECT_TRUE(std::isinf(d.degrees));
  const Difference mixed = difference_of(one, timings_of({2.30, 2.31, 2.29, 2.30}, 0, 1));
  EXPECT_TRUE(mixed.assumed);
  EXPECT_GT(mixed.error, assumed_spread);
  // Two processes that take turns are too few for pairs. Each mean has the variance assumed_spread^2 / 2.
  EXPECT_NEAR(difference_of(timings_of({1, 1}, 0, 2), timings_of({2, 2}, 1, 2)).error, assumed_spread, 1e-12);
}

TEST(Decide, SidesOfTheLimits) {
  const double degrees = 8;
  const auto side = [&](double change, double error, double threshold) {
    const Difference d{std::log1p(change), error, degrees, false, false};
    return decide(std::span(&d, 1), threshold, 0.05).front().side;
  };
  EXPECT_EQ(side(0.10, 0.01, 0.05), Side::above);
  EXPECT_EQ(side(-0.10, 0.01, 0.05), Side::below);
  EXPECT_EQ(side(0.00, 0.01, 0.05), Side::within);
  EXPECT_EQ(side(0.05, 0.01, 0.05), Side::undecided);
  EXPECT_EQ(side(0.00, 0.05, 0.05), Side::undecided);
  EXPECT_EQ(side(0.001, 1e-6, 0), Side::above);
  EXPECT_EQ(side(0.0, 1e-6, 0), Side::undecided);
  EXPECT_EQ(side(-0.9, 0.01, 1.5), Side::within);  // a threshold above 1 gives no lower limit
}

TEST(Decide, CorrectsForTheNumberOfComparisons) {
  // For alpha = 0.05, a p-value of 0.03 suffices for a single comparison. It does not suffice for each of
  // three comparisons, because Holm's limit for the smallest p-value is 0.05 / 3.
  const double degrees = 1e6;
  const auto with_t = [&](double t) { return Difference{t * 0.01, 0.01, degrees, false, false}; };
  const std::vector<Difference> one{with_t(2.17)}, three{with_t(2.17), with_t(2.17), with_t(2.17)},
      steps{with_t(2.5), with_t(2.3), with_t(2.0)};
  EXPECT_EQ(decide(one, 0, 0.05)[0].side, Side::above);
  EXPECT_EQ(decide(one, 0, p_of(one[0]))[0].side, Side::above) << "a p-value at the limit suffices";
  for (const Decision& d : decide(three, 0, 0.05)) EXPECT_EQ(d.side, Side::undecided);
  // The three p-values are below Holm's limits: 0.0124 <= 0.05 / 3, 0.0214 <= 0.05 / 2 and 0.0455 <= 0.05.
  for (const Decision& d : decide(steps, 0, 0.05)) EXPECT_EQ(d.side, Side::above);
  EXPECT_NEAR(decide(steps, 0, 0.05)[0].confidence, 1 - 0.05 / 3, 1e-12);
  EXPECT_NEAR(decide(steps, 0, 0.05)[2].confidence, 0.95, 1e-12);
}

struct Rates {
  int decided = 0, above = 0;
};

/// Counts the decisions in 4000 simulated comparisons of eight processes with eight others, with the true
/// relative difference `change` and a standard deviation of 0.02 of the logarithms of their medians.
Rates rates_of(double change, double threshold, double alpha) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0, 0.02);
  Rates rates;
  for (int i = 0; i < 4000; ++i) {
    std::vector<double> a, b;
    for (int k = 0; k < 8; ++k) {
      a.push_back(noise(random));
      b.push_back(std::log1p(change) + noise(random));
    }
    const Difference d = difference_of(timings_of(a, 0, 1), timings_of(b, 100, 1));
    const Side side = decide(std::span(&d, 1), threshold, alpha).front().side;
    rates.decided += side != Side::undecided;
    rates.above += side == Side::above;
  }
  return rates;
}

TEST(Decide, ErrsWithTheProbabilityAlpha) {
  const Rates equal = rates_of(0, 0, 0.02);
  EXPECT_GT(equal.decided, 50);  // 80 decisions are expected, with a standard deviation of 9
  EXPECT_LT(equal.decided, 115);
  // The true change equals the threshold, so the decisions `within` and `above` are both wrong.
  EXPECT_LE(rates_of(0.05, 0.05, 0.02).decided, 115);
}

TEST(Decide, FindsTheDetectableChangeWithThePromisedPower) {
  const Difference typical{0, 0.02 * std::sqrt(2.0 / 8), 14, false, false};
  const double change = detectable_change(typical, 1, 0.02, 0.05);
  // 2.14479 and 1.34503 are the quantiles 0.975 and 0.9 of Student's t for 14 degrees of freedom.
  EXPECT_NEAR(change, 1.02 * std::exp(0.01 * (2.14479 + 1.34503)) - 1, 1e-6);
  EXPECT_GT(detectable_change(typical, 2, 0.02, 0.05), change);
  const int above = rates_of(change, 0.02, 0.05).above;
  EXPECT_GT(above, 3480);  // 3600 decisions are expected
  EXPECT_LT(above, 3720);
}

// processes_needed() must return the smallest number of processes, at least fewest_processes, with which the
// detectable change is at most the estimated change.
TEST(Decide, NeedsMoreProcessesForSmallerChanges) {
  const auto needed = [](double change, std::size_t count) {
    // Five pairs of processes whose differences have a standard deviation of 2%.
    const Difference d{std::log1p(change), 0.02 / std::sqrt(5.0), 4, true, false};
    return processes_needed(d, 5, count, 0, 0.05);
  };
  const auto with = [](std::size_t processes) {
    return detectable_change({0, 0.02 / std::sqrt(double(processes)), double(processes - 1), true, false}, 1,
                             0, 0.05);
  };
  EXPECT_EQ(needed(0.5, 1), fewest_processes);
  EXPECT_GT(needed(0.01, 1), needed(0.02, 1));
  EXPECT_GT(needed(0.01, 32), needed(0.01, 1));
  for (const double change : {0.01, 0.02, 0.05, 0.072}) {
    const std::size_t n = needed(change, 1);
    EXPECT_LE(with(n), change);
    if (n > fewest_processes) {
      EXPECT_GT(with(n - 1), change);
    }
  }
  EXPECT_EQ(needed(1.0001 * with(1000), 1), 1000u);
  EXPECT_EQ(needed(1.0001 * with(1001), 1), 0u) << "no advice above 1000 processes";
  EXPECT_EQ(processes_needed({0.1, 0.07, 4, false, true}, 1, 1, 0, 0.05), 0u);
}

}  // namespace
}  // namespace pelage
