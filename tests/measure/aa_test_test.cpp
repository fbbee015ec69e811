// Tests the trials of pelage aa-test with simulated timings. A trial applies the statistical test of pelage
// compare to the times of two pipelines (a and b) whose true difference is known.
#include "harness/measure/aa_test.hpp"

#include <gtest/gtest.h>

namespace pelage {
namespace {

/// A simulated machine whose speed drifts by 10% per second. The frame times have random noise with a
/// standard deviation of 1%.
struct Machine {
  std::mt19937_64 random{3};
  std::normal_distribution<double> noise{0, 0.01};
  double now_s = 0;
  std::vector<double> nine_times(double ms) {
    std::vector<double> times;
    times.reserve(9);
    for (int i = 0; i < 9; ++i) {
      times.push_back(ms * (1 + 0.1 * now_s) * (1 + noise(random)));
      now_s += 0.01;
    }
    return times;
  }
  TimeRound round(double a_ms, double b_ms) {
    return [this, a_ms, b_ms](bool b_first) {
      RoundTimes times;
      const auto time = [this](double ms, std::vector<double>& side, double& started_s) {
        started_s = now_s;
        side = nine_times(ms);
      };
      if (b_first) time(b_ms, times.b, times.b_started_s);
      time(a_ms, times.a, times.a_started_s);
      if (!b_first) time(b_ms, times.b, times.b_started_s);
      return times;
    };
  }
};

std::vector<Trial> trials_of(double change, int count) {
  Machine machine;
  std::mt19937_64 order(5);
  std::vector<Trial> trials;
  trials.reserve(std::size_t(count));
  for (int i = 0; i < count; ++i) {
    machine.now_s = 0;
    trials.push_back(run_trial(machine.round(10, 10 * (1 + change)), {}, order));
  }
  return trials;
}

TEST(AaTest, EqualSidesAreSeldomCalledDifferent) {
  const auto trials = trials_of(0, 1000);
  const TrialCounts counts = count_of(trials);
  EXPECT_EQ(counts.all(), 1000);
  EXPECT_EQ(counts.same, 0);  // with the threshold 0, no verdict can be `same`
  EXPECT_LT(counts.faster + counts.slower, 40);
  for (const Trial& trial : trials) EXPECT_TRUE(trial.difference.paired);
}

TEST(AaTest, MoreWorkIsCalledSlower) {
  const TrialCounts counts = count_of(trials_of(0.05, 200));
  EXPECT_GT(counts.slower, 190);
  EXPECT_EQ(counts.faster, 0);
  EXPECT_EQ(count_of(trials_of(-0.05, 200)).slower, 0);
}

// R's binom.test(4, 200) and binom.test(0, 100) print the expected limits.
TEST(AaTest, IntervalsOfRates) {
  EXPECT_NEAR(rate_interval(4, 200).low, 0.005475566, 1e-8);
  EXPECT_NEAR(rate_interval(4, 200).high, 0.05041362, 1e-7);
  EXPECT_EQ(rate_interval(0, 100).low, 0);
  EXPECT_NEAR(rate_interval(0, 100).high, 0.03621669, 1e-7);
  EXPECT_EQ(rate_interval(100, 100).high, 1);
}

TEST(AaTest, OneLinePerTrial) {
  const std::string text = trials_csv("slower", trials_of(0.05, 2));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
  EXPECT_TRUE(text.starts_with("slower,0.0")) << text;
  EXPECT_NE(text.find(",1,slower\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace pelage
