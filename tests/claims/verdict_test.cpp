#include <gtest/gtest.h>

#include "harness/claims/judge.hpp"

namespace pelage::claims {
namespace {

/// Returns an estimate with 2000 draws, evenly spaced from `value` - `half` to `value` + `half`.
Estimate around(double value, double half) {
  Estimate estimate{value, {}};
  for (int i = 0; i < 2000; ++i) estimate.draws.push_back(value + half * (2 * (i + 0.5) / 2000 - 1));
  return estimate;
}

Verdict verdict_of(double value, double half, const Region& region) {
  return decide({around(value, half)}, region).verdict;
}

TEST(Verdicts, OfOneEffectFollowItsInterval) {
  const Region at_most{{}, 1.0}, at_least{1.0, {}}, between{0.8, 1.25};
  EXPECT_EQ(verdict_of(0.5, 0.2, at_most), Verdict::holds);
  EXPECT_EQ(verdict_of(1.5, 0.2, at_most), Verdict::fails);
  EXPECT_EQ(verdict_of(0.9, 0.2, at_most), Verdict::undecided);
  EXPECT_EQ(verdict_of(1.1, 0.2, at_most), Verdict::undecided);
  EXPECT_EQ(verdict_of(1.5, 0.2, at_least), Verdict::holds);
  EXPECT_EQ(verdict_of(0.5, 0.2, at_least), Verdict::fails);
  EXPECT_EQ(verdict_of(1.0, 0.1, between), Verdict::holds);
  EXPECT_EQ(verdict_of(0.6, 0.1, between), Verdict::fails);
  EXPECT_EQ(verdict_of(1.5, 0.1, between), Verdict::fails);
  EXPECT_EQ(verdict_of(1.0, 0.5, between), Verdict::undecided) << "the interval contains the whole region";
}

TEST(Verdicts, StrictLimitsExcludeTheLimit) {
  EXPECT_EQ(verdict_of(1, 0, {1.0, {}}), Verdict::holds);
  EXPECT_EQ(verdict_of(1, 0, {1.0, {}, true}), Verdict::fails);
  EXPECT_EQ(verdict_of(1, 0, {{}, 1.0, true}), Verdict::fails);
  EXPECT_FALSE((Region{1.0, {}}).outside(0.5, 1)) << "the upper end, the limit itself, is inside";
  EXPECT_FALSE((Region{{}, 1.0}).outside(1, 1.5));
  EXPECT_NEAR(margin({0.8, 1.25}, 0.9), 0.1, 1e-12);
}

TEST(Verdicts, UseThe95PercentInterval) {
  const Decision decision = decide({around(0, 1)}, {{}, 2.0});
  EXPECT_NEAR(decision.interval.low, -0.95, 0.001);
  EXPECT_NEAR(decision.interval.high, 0.95, 0.001);
  EXPECT_DOUBLE_EQ(decision.confidence, 0.95);
}

// One of ten effects is slightly above the limit 1. Its 95% interval excludes the limit, but Holm's method
// demands a 99.5% interval, which contains the limit.
TEST(Verdicts, OfSeveralEffectsAreCorrectedByHolm) {
  const Region at_most{{}, 1.0};
  const Estimate outside = around(1.97, 1);
  EXPECT_EQ(decide({outside}, at_most).verdict, Verdict::fails);
  std::vector<Estimate> ten(9, around(1.0, 1));
  ten.push_back(outside);
  const Decision decision = decide(ten, at_most);
  EXPECT_EQ(decision.verdict, Verdict::undecided);
  EXPECT_EQ(decision.decisive, 9u);
  EXPECT_NEAR(decision.confidence, 0.995, 1e-12);
  ten.back() = around(2.2, 1);
  EXPECT_EQ(decide(ten, at_most).verdict, Verdict::fails);
  // 3% and 4% of the draws contradict. The first effect is not decided at 97.5%, which ends the procedure.
  EXPECT_EQ(decide({outside, around(1.96, 1)}, at_most).verdict, Verdict::undecided);
}

// Nine of ten effects are far below the limit 1. Holm's method decides these nine first, and then decides the
// tenth effect by its 95% interval. Bonferroni's method would demand a 99.5% interval for the tenth effect.
TEST(Verdicts, HolmLeavesMoreForTheLastEffect) {
  const Region at_most{{}, 1.0};
  std::vector<Estimate> ten(9, around(-5, 1));
  ten.push_back(around(0.04, 1));
  EXPECT_EQ(decide(ten, at_most).verdict, Verdict::holds);
  EXPECT_EQ(decide(ten, at_most).decisive, 9u);
  EXPECT_DOUBLE_EQ(decide(ten, at_most).confidence, 0.95);
  ten.back() = around(0.2, 1);
  EXPECT_EQ(decide(ten, at_most).verdict, Verdict::undecided);
}

// Holm's method stops at the first effect, whose interval contains the limit. The second has more draws that
// contradict it and is undecided too, although its own, narrower interval does not contain the limit.
TEST(Verdicts, AnUndecidedClaimNamesAnEffectWhoseIntervalContainsALimit) {
  const Region at_most{{}, 1.0};
  const Decision decision = decide({around(1.97, 1), around(1.96, 1)}, at_most);
  EXPECT_EQ(decision.verdict, Verdict::undecided);
  EXPECT_FALSE(at_most.contains(decision.interval.low, decision.interval.high));
  EXPECT_FALSE(at_most.outside(decision.interval.low, decision.interval.high))
      << decision.interval.low << " to " << decision.interval.high;
}

TEST(Verdicts, OneEffectOutsideIsEnoughToFail) {
  const Region at_most{{}, 1.0};
  const Decision decision = decide({around(0, 0.5), around(5, 0.5), around(9, 0.5)}, at_most);
  EXPECT_EQ(decision.verdict, Verdict::fails);
  EXPECT_EQ(decision.decisive, 2u) << "the worst effect decides";
}

}  // namespace
}  // namespace pelage::claims
