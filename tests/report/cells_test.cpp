#include <gtest/gtest.h>

#include <algorithm>

#include "harness/error.hpp"
#include "harness/report/comparison.hpp"
#include "tests/report/rows.hpp"

namespace pelage {
namespace {

using test::table1_rows;

const Cell& named(const std::vector<Cell>& cells, const std::string& name) {
  return *std::find_if(cells.begin(), cells.end(), [&](const Cell& c) { return c.case_name == name; });
}

TEST(Cells, MedianAndFrameRate) {
  const auto cells = cells_of(table1_rows());
  ASSERT_EQ(cells.size(), 32u);
  const Cell& torus = named(cells, "torus-16-800x600");
  EXPECT_NEAR(torus.median_ms, (9360 + 480000) * 16 / 1e6, 1e-9);
  EXPECT_NEAR(torus.fps(), 1000 / torus.median_ms, 1e-12);
  EXPECT_LT(torus.interval_ms.low, torus.median_ms);
  EXPECT_GT(torus.interval_ms.high, torus.median_ms);
}

TEST(Cells, ProcessesOfOneCaseAreOneCell) {
  auto rows = table1_rows();
  auto slower = table1_rows(2);
  for (FoundRow& row : slower) row.row.repeat = 1;
  rows.insert(rows.end(), slower.begin(), slower.end());
  const auto cells = cells_of(rows);
  ASSERT_EQ(cells.size(), 32u);
  const Cell& torus = named(cells, "torus-16-800x600");
  EXPECT_EQ(torus.processes.size(), 2u);
  // The times of the two processes differ by a factor of two. The 95% interval must contain the times of
  // both.
  EXPECT_GT(torus.interval_ms.high / torus.interval_ms.low, 1.9);
}

TEST(Cells, RowsWithOtherIdentitiesAreNotCombined) {
  auto rows = table1_rows(), other = table1_rows(2);
  for (FoundRow& row : rows) row.row.identity = {{"scene", "1111111122222222"}};
  for (FoundRow& row : other) row.row.identity = {{"scene", "5555555566666666"}};
  rows.insert(rows.end(), other.begin(), other.end());
  const auto cells = cells_of(rows);
  ASSERT_EQ(cells.size(), 64u);
  for (const Cell& cell : cells) EXPECT_EQ(cell.processes.size(), 1u);
}

TEST(Compare, TwoMeasurementsOfOneNameInASetAreRefused) {
  auto rows = table1_rows(), other = table1_rows(2);
  for (FoundRow& row : rows) row.row.identity = {{"mesh", "1"}, {"scene", "1111111122222222"}};
  for (FoundRow& row : other) row.row.identity = {{"mesh", "1"}, {"scene", "5555555566666666"}};
  const auto clean = cells_of(rows);
  EXPECT_EQ(compare_cells(clean, cells_of(other), false, CompareBy(""), 0.05).size(), 32u);
  rows.insert(rows.end(), other.begin(), other.end());
  try {
    compare_cells(cells_of(rows), clean, false, CompareBy(""), 0.05);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("different inputs (scene)"), std::string::npos) << error.what();
  }
}

TEST(Cells, OneBadRowSpoilsItsCell) {
  auto rows = table1_rows();
  FoundRow bad = rows.front();
  bad.row.repeat = 1;
  bad.row.status = Status::failed_check;
  bad.row.reason = "psnr";
  rows.push_back(bad);
  const Cell cell = named(cells_of(rows), rows.front().row.case_name);
  EXPECT_EQ(cell.status, Status::failed_check);
  EXPECT_EQ(cell.median_ms, 0);
  EXPECT_FALSE(ratio_of(cell));
}

TEST(Cells, RatioCarriesTheIntervalOfAWholeFigure) {
  const auto cells = cells_of(table1_rows());
  const Cell& torus = named(cells, "torus-16-800x600");
  const Ratio r = *ratio_of(torus);
  EXPECT_NEAR(r.value, torus.fps() / 267, 1e-12);
  EXPECT_NEAR(*r.low, 1000 / torus.interval_ms.high / 267.5, 1e-12);
  EXPECT_NEAR(*r.high, 1000 / torus.interval_ms.low / 266.5, 1e-12);
}

TEST(Cells, ACensoredFigureBoundsTheRatioFromBelowOnly) {
  const Ratio r = *ratio_of(named(cells_of(table1_rows()), "lion-64-800x600"));
  EXPECT_EQ(r.relation, ">");
  EXPECT_TRUE(r.low);
  EXPECT_FALSE(r.high);
}

TEST(Compare, TellsSlowerFasterAndNoise) {
  const auto a = cells_of(table1_rows()), slower = cells_of(table1_rows(1.2)),
             near = cells_of(table1_rows(1.004));
  const CompareBy nothing("");
  for (const Pair& p : compare_cells(a, slower, false, nothing, 0.05)) {
    EXPECT_EQ(p.verdict, Verdict::slower);
    EXPECT_NEAR(p.change, 0.2, 1e-9);
  }
  for (const Pair& p : compare_cells(slower, a, false, nothing, 0.05)) EXPECT_EQ(p.verdict, Verdict::faster);
  for (const Pair& p : compare_cells(a, near, false, nothing, 0.0)) EXPECT_EQ(p.verdict, Verdict::same);
  for (const Pair& p : compare_cells(a, slower, false, nothing, 0.25)) EXPECT_EQ(p.verdict, Verdict::same);
  EXPECT_EQ(compare_cells(a, a, false, nothing, 0.05).size(), 32u);
}

TEST(Compare, ACaseThatFailsNowIsLost) {
  const auto a = cells_of(table1_rows());
  auto rows = table1_rows();
  rows[0].row.status = Status::failed_check;
  const auto pairs = compare_cells(a, cells_of(rows), false, CompareBy(""), 0.05);
  EXPECT_EQ(
      std::count_if(pairs.begin(), pairs.end(), [](const Pair& p) { return p.verdict == Verdict::lost; }), 1);
}

TEST(Compare, AcrossDevicesAndWithinOneSet) {
  const auto a = cells_of(table1_rows()), other = cells_of(table1_rows(0.5, "other device"));
  EXPECT_THROW(compare_cells(a, other, false, CompareBy(""), 0.05), InputError);
  EXPECT_EQ(compare_cells(a, other, false, CompareBy("device"), 0.05).size(), 32u);
  const auto layers = compare_cells(a, a, true, CompareBy("axes.layers"), 0.05);
  ASSERT_EQ(layers.size(), 16u);
  for (const Pair& p : layers) EXPECT_NEAR(p.change, 3, 1e-9) << p.name;
  EXPECT_THROW(CompareBy("axes."), InputError);
  EXPECT_THROW(CompareBy("host"), InputError);
}

TEST(Compare, Thresholds) {
  EXPECT_DOUBLE_EQ(threshold_from_text("5%"), 0.05);
  EXPECT_DOUBLE_EQ(threshold_from_text("0.1"), 0.1);
  for (const char* text : {"", "five", "-1%", "%", "1%%"})
    EXPECT_THROW(threshold_from_text(text), InputError) << text;
}

}  // namespace
}  // namespace pelage
