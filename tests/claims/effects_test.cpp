// Tests every effect and every quantity of a claim (docs/experiments.md) against values computed by hand.
#include "harness/claims/effects.hpp"

#include <cmath>

#include "tests/claims/rows.hpp"

namespace pelage::claims {
namespace {

using namespace test;

constexpr double rounding = 1e-9;
const char* const any = "{ above = -1000 }";

double effect_of(const std::vector<FoundRow>& rows, const std::string& effect) {
  return judged(rows, effect, any).value.value();
}

TEST(Effects, LevelIsTheQuantity) {
  const std::vector<FoundRow> rows = layers_and_models();
  const Judged times = judged(rows, "name = \"level\"", "{ at_most = 45 }");
  EXPECT_EQ(times.effects, 4u);
  EXPECT_NEAR(times.least, 10, rounding);
  EXPECT_NEAR(times.most, 40, rounding);
  EXPECT_NEAR(times.value.value(), 40, rounding) << "the case next to the limit";
  EXPECT_EQ(times.decisive, "64-b");
  const Judged rates =
      judged(rows, "name = \"level\", quantity = \"frame-rate\", combine = \"mean\"", "{ at_least = 1 }");
  EXPECT_NEAR(rates.value.value(), (100 + 1000.0 / 30 + 50 + 25) / 4, rounding);
}

TEST(Effects, RatioMatchesTheOtherAxes) {
  const std::string ratio = "name = \"ratio\", axis = \"layers\", of = 64, to = 16";
  const Judged every = judged(layers_and_models(), ratio, "{ at_most = 4 }");
  EXPECT_EQ(every.effects, 2u);
  EXPECT_NEAR(every.least, 2, rounding);
  EXPECT_NEAR(every.most, 3, rounding);
  EXPECT_EQ(every.decisive, "a");
  EXPECT_NEAR(effect_of(layers_and_models(), ratio + ", combine = \"geometric-mean\""), std::sqrt(6.0),
              rounding);
  EXPECT_NEAR(effect_of(layers_and_models(), ratio + ", combine = \"mean\""), 2.5, rounding);
  EXPECT_NEAR(effect_of(layers_and_models(), ratio + ", combine = \"median\""), 2.5, rounding);
}

// Two cases that differ in several axes are compared at each value of the other axes.
TEST(Effects, RatioComparesAnyTwoCases) {
  const std::vector<FoundRow> rows{row({{"solver", "i"}, {"step", "0.016"}, {"model", "a"}}, 12),
                                   row({{"solver", "i"}, {"step", "0.002"}, {"model", "a"}}, 40),
                                   row({{"solver", "e"}, {"step", "0.002"}, {"model", "a"}}, 48),
                                   row({{"solver", "i"}, {"step", "0.016"}, {"model", "b"}}, 10),
                                   row({{"solver", "e"}, {"step", "0.002"}, {"model", "b"}}, 20)};
  const std::string effect =
      "name = \"ratio\", of = { solver = \"i\", step = \"0.016\" }, to = { solver = \"e\", step = \"0.002\" }";
  const Judged both = judged(rows, effect, "{ below = 1 }");
  EXPECT_EQ(both.effects, 2u);
  EXPECT_NEAR(both.least, 0.25, rounding);
  EXPECT_NEAR(both.most, 0.5, rounding);
  EXPECT_EQ(both.verdict, Verdict::holds);
  EXPECT_EQ(both.decisive, "b");
  // Without the second case of model b, only model a decides, and the case is named.
  const Judged one = judged({rows.begin(), rows.end() - 1}, effect, "{ below = 1 }");
  EXPECT_EQ(one.effects, 1u);
  EXPECT_EQ(one.notes.at(0),
            "1 left out: b-i-0.016 (there is no matching case with solver = e, step = 0.002)");
  // A selection that names fewer axes must still select one case.
  EXPECT_EQ(judged({rows.begin(), rows.begin() + 3},
                   "name = \"ratio\", of = { solver = \"i\" }, to = { step = \"0.002\" }", any)
                .verdict,
            Verdict::untestable);
}

TEST(Effects, PhasesAreTimesOfTheSameRow) {
  FoundRow one = row({{"model", "a"}}, 60);
  one.row.samples["simulate"].event_ms = {3, 6, 9};
  one.row.samples["quarter"].wall_ms = {20, 20, 20};
  EXPECT_NEAR(effect_of({one}, "name = \"level\", quantity = \"phase-time\", phase = \"simulate\""), 6,
              rounding);
  EXPECT_NEAR(effect_of({one}, "name = \"level\", quantity = \"phase-share\", phase = \"simulate\""), 0.1,
              rounding);
  const Judged turns = judged(
      {one}, "name = \"ratio\", axis = \"layers\", phases = { frame = 64, quarter = 16 }, of = 64, to = 16",
      any);
  EXPECT_NEAR(turns.value.value(), 3, rounding);
}

// The frame times, 90 and 100 ms, differ only by noise. The phase times, 7 and 2 ms, differ by 5 ms.
// The effect is 1 plus the quotient of this difference and the frame time of the solver "e": 1 + 5 / 100.
TEST(Effects, RatioByPhaseIgnoresTheOtherPhases) {
  FoundRow slow = row({{"solver", "i"}}, 90), fast = row({{"solver", "e"}}, 100);
  slow.row.samples["simulate"].event_ms = {7};
  fast.row.samples["simulate"].event_ms = {2};
  EXPECT_NEAR(
      effect_of({slow, fast},
                "name = \"ratio-by-phase\", phase = \"simulate\", axis = \"solver\", of = \"i\", to = \"e\""),
      1.05, rounding);
}

TEST(Effects, ElasticityIsTheExponent) {
  std::vector<FoundRow> rows;
  for (const int n : {16, 32, 64}) rows.push_back(row({{"layers", std::to_string(n)}}, 5 * std::pow(n, 0.7)));
  const std::string by_layers = "name = \"elasticity\", axis = \"layers\"";
  EXPECT_NEAR(effect_of(rows, by_layers), 0.7, rounding);
  EXPECT_EQ(effect_of({row({{"layers", "16"}}, 10), row({{"layers", "64"}}, 10)}, by_layers), 0)
      << "equal times neither decrease nor increase";
  // For picture sizes, the elasticity uses the number of pixels. Four times the pixels take twice the time,
  // so the exponent is 0.5.
  EXPECT_NEAR(effect_of({row({{"size", "800x600"}}, 10), row({{"size", "1600x1200"}}, 20)},
                        "name = \"elasticity\", axis = \"size\""),
              0.5, rounding);
  // Names of models are not numbers, so the option `along` uses the metric `triangles` in their place.
  FoundRow small = row({{"model", "a"}}, 10), large = row({{"model", "b"}}, 80);
  small.row.metrics["triangles"] = {100, "triangles"};
  large.row.metrics["triangles"] = {800, "triangles"};
  EXPECT_NEAR(effect_of({large, small}, "name = \"elasticity\", axis = \"model\", along = \"triangles\""), 1,
              rounding);
}

TEST(Effects, LinearityComparesTwoSlopes) {
  const std::string effect = "name = \"linearity\", axis = \"layers\"";
  const auto rows = [](double upper) {
    return std::vector<FoundRow>{row({{"layers", "64"}}, 26 + upper), row({{"layers", "16"}}, 10),
                                 row({{"layers", "32"}}, 26), row({{"layers", "24"}}, 18)};
  };
  EXPECT_NEAR(effect_of(rows(32), effect), 1, rounding);
  EXPECT_NEAR(effect_of(rows(48), effect), 1.5, rounding);
  const Judged two = judged(layers_and_models(), effect, any);
  EXPECT_EQ(two.verdict, Verdict::untestable) << "two values give no slopes to compare";
  EXPECT_EQ(judged(rows(32), effect + ", values = 5", any).verdict, Verdict::untestable);
}

// The ratio of the times at the two sizes is 40 * triangles^-0.5, so its log-log slope must be -0.5.
TEST(Effects, RatioTrendIsTheSlopeOfTheRatio) {
  std::vector<FoundRow> rows;
  for (const auto& [model, triangles] : {std::pair("a", 100.0), {"b", 400.0}, {"c", 1600.0}})
    for (const char* size : {"1", "2"}) {
      FoundRow one = row({{"model", model}, {"size", size}},
                         size[0] == '1' ? triangles : triangles * 40 / std::sqrt(triangles));
      one.row.metrics["triangles"] = {triangles, "triangles"};
      rows.push_back(one);
    }
  const Judged trend = judged(
      rows,
      "name = \"ratio-trend\", axis = \"size\", of = 2, to = 1, across = \"model\", along = \"triangles\"",
      "\"decreasing\"");
  EXPECT_NEAR(trend.value.value(), -0.5, rounding);
  EXPECT_EQ(trend.verdict, Verdict::holds);
}

TEST(Effects, ShareOfCasesCountsThoseAboveTheThreshold) {
  std::vector<FoundRow> rows = layers_and_models();
  rows[2].row.metrics["paper_fps"] = {101, "fps", "<", {}, 101.0};
  rows[3].row.metrics["paper_fps"] = {40, "fps", "<", {}, 40.0};
  const Judged share =
      judged(rows, "name = \"share-of-cases\", quantity = \"frame-rate\", threshold = 50", any);
  EXPECT_NEAR(share.value.value(), 0.5, rounding) << "100, 33, 50 and 25 frames per second";
  EXPECT_EQ(share.effects, 4u);
  EXPECT_EQ(share.paper_value, 0.5) << "half of the bound counts, 50.5 and 20 frames per second";
  rows[2].row.metrics.clear();
  rows[3].row.metrics["paper_fps"] = {1, "fps", "<", {}, 1.0};
  const std::string low = "name = \"share-of-cases\", quantity = \"frame-rate\", threshold = 0.7";
  EXPECT_EQ(judged(rows, low, any).paper_interval.low, 0) << "the draws begin at 0";
}

TEST(Effects, MetricsMayBeDividedByAnother) {
  FoundRow one = row({{"model", "a"}}, 10);
  one.row.metrics["masses"] = {600, "masses"};
  one.row.metrics["triangles"] = {100, "triangles"};
  const std::string masses = "name = \"level\", quantity = \"metric\", metric = \"masses\"";
  EXPECT_NEAR(effect_of({one}, masses), 600, rounding);
  const Judged divided = judged({one}, masses + ", per = \"triangles\"", any);
  EXPECT_NEAR(divided.value.value(), 6, rounding);
  EXPECT_NEAR(divided.interval.high, 6, rounding);
  one.row.metrics["paper_fps"] = {50, "fps"};
  EXPECT_NEAR(effect_of({one}, "name = \"level\", quantity = \"frame-rate\", per = \"paper_fps\""), 2,
              rounding);
  one.row.metrics["paper_fps"] = {0, "fps"};
  EXPECT_FALSE(judged({one}, "name = \"level\"", any).paper_value) << "no frame time follows from the rate 0";
}

TEST(Effects, OfThePapersNumbersUseItsRounding) {
  std::vector<FoundRow> rows = layers_and_models();
  const double rates[] = {267, 90, 100, 50};
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i].row.metrics["paper_fps"] = {rates[i], "fps", "=", rates[i] - 0.5, rates[i] + 0.5};
  const std::string effect =
      "name = \"ratio\", axis = \"layers\", of = 64, to = 16, quantity = \"frame-rate\", combine = \"geometric-mean\"";
  const Judged all = judged(rows, effect, any);
  EXPECT_NEAR(all.paper_value.value(), std::sqrt(90.0 / 267 * 0.5), rounding);
  EXPECT_LT(all.paper_interval.low, all.paper_value.value());
  EXPECT_GT(all.paper_interval.high, all.paper_value.value());
  EXPECT_LT(all.paper_interval.high / all.paper_interval.low, 1.02);
  EXPECT_NEAR(judged(rows, "name = \"level\", combine = \"median\"", any).paper_value.value(),
              (1000.0 / 100 + 1000.0 / 90) / 2, rounding);
  rows[3].row.metrics["paper_fps"] = {1, "fps", "<", {}, 1.0};
  EXPECT_NEAR(judged(rows, effect, any).paper_value.value(), 90.0 / 267, rounding)
      << "an upper bound is no number";
}

}  // namespace
}  // namespace pelage::claims
