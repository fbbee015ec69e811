// The direction of a ratio follows from its name alone; earlier schemas are read under the present names.
#include "harness/record/ratios.hpp"

#include "tests/support/fake.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

/// Returns a row whose frames take twice as long as the phase, with one metric.
Row row_with(int schema, const std::string& phase, const std::string& metric, double value) {
  Row row = test::sample_row("a");
  row.schema = schema;
  for (const double ms : row.samples.at("frame").wall_ms) row.samples[phase].wall_ms.push_back(ms / 2);
  row.metrics = {{metric, {value, "times"}}};
  return row;
}

std::string row_refusal(const Row& row) {
  return test::refusal([&] { row_from_line(to_line(row)); }, "");
}

TEST(Ratios, OfAnInventedPhaseHaveOneDirection) {
  for (const char* phase : {"nest", "half", "quarter", "baseline"}) {
    const std::string ratio = ratio_metric(phase), inverse = frame_over_metric(phase);
    EXPECT_EQ(row_refusal(row_with(3, phase, ratio, 0.5)), "") << phase;
    EXPECT_EQ(row_refusal(row_with(3, phase, ratio, 2)),
              "the metric " + ratio + " is 2, but the row's times give 0.5");
    EXPECT_EQ(row_refusal(row_with(3, phase, inverse, 2)), "") << phase;
    EXPECT_EQ(row_refusal(row_with(3, phase, inverse, 0.5)),
              "the metric " + inverse + " is 0.5, but the row's times give 2");
  }
}

TEST(Ratios, OfEarlierSchemasAreReadUnderTheirPresentNames) {
  for (const int schema : {1, 2})
    for (const char* phase : {"half", "quarter", "baseline"}) {
      Row old = row_with(schema, phase, ratio_metric(phase), 2);
      old.provenance["view"] = {{"x", "triangles"}, {"y", {ratio_metric(phase), "nest_ratio"}}};
      const Row row = row_from_line(to_line(old));
      ASSERT_EQ(row.metrics.size(), 1u);
      EXPECT_EQ(row.metrics.at(frame_over_metric(phase)).value, 2);
      EXPECT_EQ(row.provenance["view"]["x"], "triangles");
      EXPECT_EQ(row.provenance["view"]["y"],
                nlohmann::ordered_json({frame_over_metric(phase), "nest_ratio"}));
      EXPECT_EQ(row.schema, schema == 1 ? 1 : 3);
      EXPECT_EQ(to_line(row_from_line(to_line(row))), to_line(row)) << "a merged row stays the same row";
      EXPECT_NE(row_refusal(row_with(schema, phase, ratio_metric(phase), 0.5)), "") << "the other direction";
    }
  EXPECT_EQ(row_refusal(row_with(2, "opengl", "opengl_ratio", 0.5)), "");
  EXPECT_NE(row_refusal(row_with(2, "opengl", "opengl_ratio", 2)), "");
}

TEST(Ratios, AUserReadsThePresentNameOfAnOldOne) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(present_metric("half_ratio", "own.toml"), "frame_over_half");
  EXPECT_EQ(present_metric("opengl_ratio", "own.toml"), "opengl_ratio");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "pelage: own.toml: the metric half_ratio is now called frame_over_half\n");
}

}  // namespace
}  // namespace pelage
