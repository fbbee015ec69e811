// Tests the table of variants that draw the same picture. The rows have synthetic times.
#include <gtest/gtest.h>

#include <algorithm>

#include "harness/report/report.hpp"
#include "tests/report/rows.hpp"

namespace pelage {
namespace {

/// Returns a row for every case of rival-options.toml. The variant "byte" takes 5 ms per layer, "volume"
/// fails its check, and all others take 10 ms per layer.
std::vector<FoundRow> option_rows() {
  std::vector<FoundRow> rows = test::bare_rows("rival-options", "quick");
  for (FoundRow& found : rows) {
    Row& row = found.row;
    const double ms = std::stod(row.axes.at("layers")) * (row.variant == "byte" ? 5 : 10);
    if (row.variant == "volume")
      row.status = Status::failed_check;
    else
      row.samples["frame"].wall_ms.assign(11, ms);
  }
  return rows;
}

TEST(WayTable, HasTheFastestFirstAndNoTimeForAnotherPicture) {
  const std::vector<FoundRow> rows = option_rows();
  const auto tables = way_tables(cells_of(rows));
  ASSERT_EQ(tables.size(), 1u);
  const WayTable& table = tables[0];
  ASSERT_EQ(table.columns.size(), 2u);
  EXPECT_EQ(table.columns[0].layers, "16");
  EXPECT_EQ(table.columns[1].fastest_ms, 320);
  ASSERT_EQ(table.rows.size(), 13u);
  EXPECT_EQ(table.rows.front().way, "byte");
  EXPECT_NEAR(table.rows.front().times, 1, 1e-12);
  EXPECT_NEAR(table.rows[1].times, 2, 1e-12);
  EXPECT_EQ(table.rows.back().way, "volume");
  EXPECT_EQ(table.rows.back().times, 0);
  for (const std::string& text : {text_of(table), html_of(table)}) {
    EXPECT_NE(text.find("320 [320, 320]"), std::string::npos) << text;
    EXPECT_NE(text.find("failed-check"), std::string::npos) << text;
  }
  const std::string csv = csv_of(table);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 27);
  EXPECT_NE(csv.find("volume,torus,16,800x600,test device,failed-check,,,,,1"), std::string::npos) << csv;
}

TEST(WayTable, IsOnlyMadeOfManyWaysAndThenInPlaceOfThePapersTables) {
  const auto no_note = [](const std::string&) { return std::string(); };
  std::vector<FoundRow> rows = option_rows();
  EXPECT_TRUE(paper_tables(cells_of(rows), no_note).empty());
  std::erase_if(rows, [](const FoundRow& found) {
    return found.row.variant != "byte" && found.row.variant != "opengl" && found.row.variant != "pow";
  });
  EXPECT_TRUE(way_tables(cells_of(rows)).empty());
  EXPECT_EQ(paper_tables(cells_of(rows), no_note).size(), 3u);
}

}  // namespace
}  // namespace pelage
