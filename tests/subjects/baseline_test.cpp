// Tests the subject that draws, in every round, a case and the same case without the settings of its named
// axes.
#include <gtest/gtest.h>

#include "harness/subjects/baseline_scene.hpp"
#include "tests/support/fake.hpp"

namespace pelage {
namespace {

Experiment two_readings() {
  Experiment e;
  e.name = "fake";
  e.axes = {{"model", {"torus", "pear"}}, {"reading", {"plain", "curled"}}, {"fur.layers", {"8", "16"}}};
  e.scene = {{"fur.length", "0.1"}, {"curl.radius", "0.0"}};
  e.at["reading"]["curled"] = {{"curl.radius", "0.03"}, {"curl.turns", "2.0"}};
  e.at["model"]["pear"] = {{"fur.length", "0.09"}};
  e.presets["quick"] = {};
  return e;
}

Case case_named(const Experiment& e, const std::string& name) {
  for (const Case& c : cases_of(e, e.presets.at("quick"), {}))
    if (c.name == name) return c;
  throw std::logic_error("no case " + name);
}

TEST(Baseline, HasTheFirstValueOfNamedAxesAndAllOtherSettings) {
  const Experiment e = two_readings();
  const Case curled = case_named(e, "pear-curled-16"), plain = baseline_case(e, curled);
  EXPECT_EQ(curled.settings.at("curl.radius"), "0.03");
  EXPECT_EQ(plain.settings.at("curl.radius"), "0.0");
  EXPECT_FALSE(plain.settings.contains("curl.turns"));
  EXPECT_EQ(plain.settings.at("fur.length"), "0.09");
  EXPECT_EQ(plain.axes.at("reading"), "plain");
  EXPECT_EQ(plain.axes.at("model"), "pear");
  EXPECT_EQ(plain.set, curled.set);
  EXPECT_EQ(plain.settings, case_named(e, "pear-16").settings);
}

/// Frames take 3 ms with curls and 2 ms without. If `bad` is the name of a case, its picture fails the check.
MakeSubject by_curls(const std::string& bad) {
  return [bad](const Case& which) -> std::unique_ptr<Subject> {
    const double ms = which.settings.at("curl.radius") == "0.0" ? 2 : 3;
    return std::make_unique<test::FakeSubject>(ms, which.name == bad ? 40.0 : 80.0);
  };
}

Row row_with(const std::string& bad = "") {
  const Experiment e = two_readings();
  RunPlan plan = test::fake_plan(1);
  plan.cases[0] = case_named(e, "torus-curled-8");
  return run_case(plan, plan.cases[0], {0, 6, 10, 0.5, 1},
                  [&](const Case& which) { return against_baseline_scene(by_curls(bad), e, which); });
}

TEST(Baseline, IsTimedInTurnsWithTheCase) {
  const Row row = row_with();
  EXPECT_EQ(row.status, Status::ok) << row.reason;
  EXPECT_EQ(row.samples.at("baseline").wall_ms.size(), row.samples.at("frame").wall_ms.size());
  EXPECT_NEAR(row.metrics.at("frame_over_baseline").value, 1.5, 0.01);
  EXPECT_LE(row.metrics.at("frame_over_baseline").low, row.metrics.at("frame_over_baseline").value);
  EXPECT_EQ(row.metrics.at("baseline_psnr").value, 200);
  EXPECT_EQ(row.metrics.at("baseline_ssim").value, 1);
}

TEST(Baseline, ThatFailsItsCheckFailsTheRow) {
  EXPECT_EQ(row_with("torus-curled-8").status, Status::failed_check);
  const Row row = row_with("torus-8");
  EXPECT_EQ(row.status, Status::failed_check);
  EXPECT_NE(row.reason.find("reference, baseline"), std::string::npos) << row.reason;
}

}  // namespace
}  // namespace pelage
