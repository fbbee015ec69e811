// A subject is an object whose frames an experiment times. This file tests the subject that draws three
// frames in every round: with all, with half and with a quarter of the layers. The reported ratios of frame
// times must be medians over the rounds. If one of the three pictures fails its check, the row must fail.
#include <gtest/gtest.h>

#include "harness/subjects/fewer_layers.hpp"
#include "tests/support/fake.hpp"

namespace pelage {
namespace {

/// Makes subjects whose frames take 1 ms per layer. If a subject's number of layers is equal to `bad`, its
/// picture fails the check.
MakeSubject as_many_ms_as_layers(int bad) {
  return [bad](const Case& which) -> std::unique_ptr<Subject> {
    EXPECT_EQ(which.set.back().first, "fur.layers");  // the last setting overrides the others
    const int layers = std::stoi(which.set.back().second);
    return std::make_unique<test::FakeSubject>(double(layers), layers == bad ? 40.0 : 80.0);
  };
}

Row row_of(int layers, int bad = 0) {
  RunPlan plan = test::fake_plan(1);
  plan.cases[0].pipeline = "shells+fewer";
  return run_case(plan, plan.cases[0], {0, 6, 10, 0.5, 1},
                  [&](const Case& which) { return fewer_layers(as_many_ms_as_layers(bad), which, layers); });
}

TEST(Layers, AreTimedInTurnsWithHalfAndAQuarterOfThem) {
  const Row row = row_of(64);
  EXPECT_EQ(row.status, Status::ok) << row.reason;
  EXPECT_EQ(row.samples.at("half").wall_ms.size(), row.samples.at("frame").wall_ms.size());
  // Each synthetic frame takes 0.001 ms longer than the frame before it. At most ten frames are drawn, so the
  // times increase by at most 0.01 ms.
  EXPECT_NEAR(row.metrics.at("frame_over_half").value, 2, 2 * 0.01 / 32);
  EXPECT_NEAR(row.metrics.at("frame_over_quarter").value, 4, 4 * 0.01 / 16);
  EXPECT_LE(row.metrics.at("frame_over_half").low, row.metrics.at("frame_over_half").value);
}

TEST(Layers, ThatFailTheirCheckFailTheRow) {
  for (const int bad : {64, 32, 16}) {
    const Row row = row_of(64, bad);
    EXPECT_EQ(row.status, Status::failed_check) << bad;
    EXPECT_TRUE(row.samples.empty());
  }
  EXPECT_NE(row_of(64, 16).reason.find("reference, quarter"), std::string::npos);
}

TEST(Layers, MustBeAMultipleOfFour) {
  const Row row = row_of(6);
  EXPECT_NE(row.status, Status::ok);
  EXPECT_NE(row.reason.find("fur.layers is 6; give a multiple of 4, because shells+fewer also draws"),
            std::string::npos)
      << row.reason;
}

}  // namespace
}  // namespace pelage
