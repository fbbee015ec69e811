// Tests the remarks below the table of any experiment, and the names of cases in them.
#include <gtest/gtest.h>

#include <algorithm>

#include "harness/report/case_table.hpp"
#include "harness/report/sections.hpp"
#include "harness/table/render.hpp"
#include "tests/report/rows.hpp"

namespace pelage {
namespace {

std::vector<Section> sections_without_notes(const std::vector<FoundRow>& rows) {
  std::vector<std::string> notes;
  return sections_of(cells_of(rows), {{}, false, false, &notes});
}

TEST(CaseSection, ANumberInANameHasTheNameOfItsAxis) {
  Cell cell;
  cell.axes = {{"model", "torus"}, {"curl.radius", "0.0"}, {"mood", "dry"}, {"dynamics.topology", "sticks"},
               {"layers", "16"},   {"size", "800x600"}};
  EXPECT_EQ(name_of(cell), "torus, curl.radius 0.0, sticks, dry, 16 layers, 800x600");
}

TEST(CaseSection, ShowsTheRatioToABaselineAndTheStepsPerFrame) {
  std::vector<FoundRow> rows =
      test::own_rows({{"dynamics.topology", {"sticks", "prisms"}}, {"variant", {"rk4", "explicit-euler"}}});
  for (FoundRow& found : rows) {
    Row& row = found.row;
    row.metrics["serial-fast_ratio"] = {2.05, "times", "", 1.9, 2.1};
    row.metrics["substeps"] = {row.variant == "rk4" ? 4.0 : 16.0, "steps"};
    row.provenance["view"] = {{"columns", {"dynamics.topology"}},
                              {"values", {"median_ms", "serial-fast_ratio"}}};
  }
  const std::string text = text_of(sections_without_notes(rows).at(0).table);
  EXPECT_NE(text.find("2.05 [1.90, 2.10]"), std::string::npos) << text;
  EXPECT_NE(text.find("NAME_ratio: time of the baseline NAME divided by our time"), std::string::npos)
      << text;
  EXPECT_NE(text.find("Time steps per frame: explicit-euler 16, rk4 4."), std::string::npos) << text;
  for (FoundRow& found : rows) found.row.metrics["substeps"].value = 4;
  EXPECT_EQ(text_of(sections_without_notes(rows).at(0).table).find("Time steps"), std::string::npos);
}

TEST(CaseSection, SaysWhichCaseARatioAboveOneMakesSlower) {
  std::vector<FoundRow> rows = test::own_rows({{"mood", {"dry", "wet"}}});
  const auto text_with = [&](const std::string& ratio) {
    for (FoundRow& found : rows) {
      found.row.metrics = {{ratio, {1.25, "times", "", 1.2, 1.3}}};
      found.row.provenance["view"] = {{"values", {ratio}}};
    }
    return text_of(sections_without_notes(rows).at(0).table);
  };
  EXPECT_NE(text_with("frame_over_baseline").find("Above 1, the case is slower."), std::string::npos);
  EXPECT_EQ(text_with("frame_over_baseline").find("ours is faster"), std::string::npos);
  EXPECT_NE(text_with("frame_over_half").find("divided by the time of a frame with half"), std::string::npos);
  EXPECT_EQ(text_with("frame_over_half").find("ours is faster"), std::string::npos);
}

// The titles of these experiments promise frames per second. Their preset smoke has no published numbers.
TEST(CaseSection, CasesWithoutPublishedNumbersOfTable1ShowFramesPerSecond) {
  std::vector<FoundRow> rows = test::bare_rows("silva2010-table1", "smoke");
  ASSERT_FALSE(rows.empty());
  for (FoundRow& found : rows) found.row.samples["frame"].wall_ms.assign(11, 20.0);
  const Table table = sections_without_notes(rows).at(0).table;
  EXPECT_EQ(table.layout.values, std::vector<std::string>{"fps"});
  EXPECT_NE(text_of(table).find("Frames per second: 1000 divided by"), std::string::npos) << text_of(table);
}

TEST(CaseSection, NamesCasesWithEqualPictures) {
  std::vector<FoundRow> rows = test::own_rows({{"mood", {"dry", "soaked", "windy"}}});
  rows[0].row.image_hash = rows[1].row.image_hash = "0000000000000001";
  rows[2].row.image_hash = "0000000000000002";
  const auto remarks_of = [](const std::vector<FoundRow>& all) {
    return sections_without_notes(all).at(0).table.remarks;
  };
  const std::string remark =
      "Equal pictures: (dry) and (soaked). The settings in which these cases differ change no pixel.";
  auto remarks = remarks_of(rows);
  EXPECT_EQ(std::count(remarks.begin(), remarks.end(), remark), 1)
      << text_of(sections_without_notes(rows).at(0).table);
  rows[1].row.image_hash = "0000000000000003";
  remarks = remarks_of(rows);
  EXPECT_EQ(std::count(remarks.begin(), remarks.end(), remark), 0);
  // Variants are different ways to compute the same picture.
  rows = test::own_rows({{"variant", {"a", "b"}}});
  rows[0].row.image_hash = rows[1].row.image_hash = "0000000000000001";
  for (const std::string& text : remarks_of(rows)) EXPECT_EQ(text.find("Equal pictures"), std::string::npos);
}

}  // namespace
}  // namespace pelage
