// Tests the table of the paper's pipeline time divided by our time. The rows have synthetic times.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/report/report.hpp"
#include "tests/report/rows.hpp"

namespace pelage {
namespace {

/// Returns a row for every case of rivals.toml. Our time is 10 ms with curls and 8 ms for plain shells. On
/// the torus, OpenGL takes 4 times our time. On all other models, OpenGL takes 9 times our time with curls,
/// and 6 times our time for plain shells.
std::vector<FoundRow> duel_rows() {
  std::vector<FoundRow> rows = test::bare_rows("rivals", "paper");
  for (FoundRow& found : rows) {
    Row& row = found.row;
    const bool torus = row.axes.at("model") == "torus", plain = row.axes.at("reading") == "plain";
    const double ours = plain ? 8 : 10, ratio = torus ? 4 : plain ? 6 : 9;
    for (int i = 0; i < 11; ++i) {
      row.samples["frame"].wall_ms.push_back(ours);
      row.samples["opengl"].wall_ms.push_back(ours * ratio);
    }
    row.metrics["triangles"] = {torus ? 9360.0 : 20000.0, "triangles"};
    row.metrics["opengl_ratio"] = {ratio, "times", "", ratio - 1, ratio + 1};
    row.provenance["opengl_renderer"] = "softpipe, Mesa";
  }
  return rows;
}

TEST(RivalTable, HoldsEveryCellsRatioAndTheirMeans) {
  const std::vector<FoundRow> rows = duel_rows();
  ASSERT_EQ(rows.size(), 64u);
  const auto tables = rival_tables(rows);
  ASSERT_EQ(tables.size(), 1u);
  const RivalTable& table = tables[0];
  ASSERT_EQ(table.columns.size(), 4u);
  EXPECT_EQ(table.columns[0].layers, "16");
  EXPECT_EQ(table.columns[1].size, "1680x1050");
  ASSERT_EQ(table.rows.size(), 16u);
  EXPECT_EQ(table.rows.front().model, "torus");
  ASSERT_TRUE(table.rows.front().entries[0] && table.rows.front().entries[0]->ratio);
  EXPECT_EQ(table.rows.front().entries[0]->ratio->value, 4);
  EXPECT_NEAR(*table.rows.front().entries[0]->opengl_ms, 40, 1e-9);
  ASSERT_EQ(table.summary.size(), 2u);
  EXPECT_EQ(table.summary[0].reading, "default");
  EXPECT_EQ(table.summary[0].timed, 32u);
  EXPECT_NEAR(table.summary[0].mean, std::pow(4 * std::pow(9.0, 7), 1.0 / 8), 1e-9);
  EXPECT_EQ(table.summary[0].least, 4);
  EXPECT_EQ(table.summary[0].least_cell, "torus, 16 layers, 800x600");
  EXPECT_EQ(table.overhead.cells, 32u);
  EXPECT_NEAR(table.overhead.ours, 10.0 / 8, 1e-9);
  EXPECT_NEAR(table.overhead.opengl, 10.0 / 8 * std::pow(1.5, 7.0 / 8), 1e-9);
  const std::string csv = csv_of(table);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 65);
  for (const std::string& text : {text_of(table), html_of(table)}) {
    EXPECT_NE(text.find("9.00 [8.00, 10.00]"), std::string::npos) << text;
    EXPECT_NE(text.find("least 4.00 (torus, 16 layers, 800x600)"), std::string::npos) << text;
    EXPECT_NE(text.find("softpipe"), std::string::npos) << text;
  }
}

TEST(RivalTable, CountsWhatHasNoRatioAndIsNoneOfThePapersTables) {
  std::vector<FoundRow> rows = duel_rows();
  EXPECT_TRUE(paper_tables(cells_of(rows), [](const std::string&) { return std::string(); }).empty());
  for (FoundRow& found : rows)
    if (found.row.axes.at("model") == "torus") {
      found.row.status = Status::failed_check;
      found.row.samples.clear();
    }
  const RivalTable table = rival_tables(rows)[0];
  EXPECT_EQ(table.summary[0].cells, 32u);
  EXPECT_EQ(table.summary[0].timed, 28u);
  EXPECT_NEAR(table.summary[0].mean, 9, 1e-9);
  EXPECT_NE(text_of(table).find("over 28 of 32 cells"), std::string::npos);
  EXPECT_TRUE(rival_tables({}).empty());
  for (FoundRow& found : rows) found.row.overrides["fur.length"] = "0.1";
  EXPECT_TRUE(rival_tables(rows).empty());
}

}  // namespace
}  // namespace pelage
