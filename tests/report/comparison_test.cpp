#include "harness/report/comparison.hpp"

#include <algorithm>
#include <cmath>

#include "harness/error.hpp"
#include "tests/report/rows.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

/// Returns cells that combine the rows of `count` processes. The processes' medians differ by up to 1%.
std::vector<Cell> processes(int count, double factor = 1, const std::string& device = "test device") {
  std::vector<FoundRow> all;
  for (int repeat = 0; repeat < count; ++repeat)
    for (FoundRow& row : test::table1_rows(factor * (1 + 0.005 * std::sin(7.0 * repeat)), device)) {
      row.row.repeat = repeat;
      all.push_back(row);
    }
  return cells_of(all);
}

std::vector<Pair> compared(const std::vector<Cell>& a, const std::vector<Cell>& b, double threshold) {
  return compare_cells(a, b, false, CompareBy(""), {.threshold = threshold});
}

void expect_all(const std::vector<Pair>& pairs, Verdict verdict) {
  EXPECT_EQ(pairs.size(), 32u);
  for (const Pair& p : pairs) EXPECT_EQ(p.verdict, verdict) << p.name;
}

TEST(Compare, DecidesFromSeveralProcesses) {
  const auto a = processes(5), slower = processes(5, 1.2), near = processes(5, 1.004);
  for (const Pair& p : compared(a, slower, 0.05)) {
    EXPECT_EQ(p.verdict, Verdict::slower);
    EXPECT_NEAR(p.change, 0.2, 1e-9);
    EXPECT_NEAR(p.b_ms / p.a_ms - 1, p.change, 1e-9);
    EXPECT_LT(p.interval.low, 0.2);
    EXPECT_GT(p.interval.low, 0.05);
    EXPECT_GT(p.interval.high, 0.2);
    EXPECT_LT(p.interval.high, 0.4);
    EXPECT_EQ(p.a_processes, 5u);
    EXPECT_FALSE(p.assumed);
    EXPECT_GT(p.detectable, 0.05);
    EXPECT_LT(p.detectable, 0.12);
    EXPECT_EQ(p.needed, 0u) << "the verdict needs no more processes";
  }
  expect_all(compared(slower, a, 0.05), Verdict::faster);
  expect_all(compared(a, near, 0.05), Verdict::same);
  expect_all(compared(a, slower, 0.5), Verdict::same);
}

TEST(Compare, WithinOneSetTheSmallerValueComesFirst) {
  std::vector<Cell> cells = processes(3);
  std::reverse(cells.begin(), cells.end());
  for (const bool reversed : {true, false}) {
    if (!reversed) std::reverse(cells.begin(), cells.end());
    const std::vector<Pair> pairs = compare_cells(cells, {}, true, CompareBy("axes.layers"), {});
    ASSERT_EQ(pairs.size(), 16u);
    for (const Pair& p : pairs) {
      EXPECT_EQ(p.a, "16") << p.name;
      EXPECT_EQ(p.b, "64") << p.name;
      EXPECT_NEAR(p.change, 3, 1e-9) << p.name;
    }
  }
}

TEST(Compare, DoesNotCallOverlappingTimesTheSame) {
  expect_all(compared(processes(5), processes(5, 1.004), 0), Verdict::undecided);
  expect_all(compared(processes(5), processes(5, 1.05), 0.05), Verdict::undecided);
}

TEST(Compare, OneProcessDecidesOnlyLargeChanges) {
  const auto a = processes(1);
  for (const Pair& p : compared(a, a, 0.05)) {
    EXPECT_EQ(p.verdict, Verdict::undecided);
    EXPECT_TRUE(p.assumed);
  }
  expect_all(compared(a, processes(1, 1.2), 0.05), Verdict::undecided);
  expect_all(compared(a, processes(1, 2), 0.05), Verdict::slower);
}

TEST(Compare, MarksContendedRows) {
  auto rows = test::table1_rows();
  rows[0].row.provenance["other_cpu_share"] = 0.5;
  rows[0].row.overrides["layers"] = rows[0].row.axes["layers"];  // --axis names a value that both sets have
  const auto pairs = compared(cells_of(rows), processes(1), 0.05);
  EXPECT_EQ(std::count_if(pairs.begin(), pairs.end(), [](const Pair& p) { return p.contended; }), 1);
}

TEST(Compare, ACaseThatFailsNowIsLost) {
  auto rows = test::table1_rows();
  rows[0].row.status = Status::failed_check;
  const auto pairs = compared(processes(1), cells_of(rows), 0.05);
  const auto lost = std::find_if(pairs.begin(), pairs.end(), [](const Pair& p) { return p.b_ms == 0; });
  ASSERT_NE(lost, pairs.end());
  EXPECT_EQ(lost->verdict, Verdict::lost);
  EXPECT_EQ(lost->reason, "failed-check");
  EXPECT_EQ(std::pair(lost->interval.low, lost->interval.high), std::pair(0.0, 0.0));
  EXPECT_EQ(std::tuple(lost->change, lost->confidence, lost->p, lost->detectable, lost->needed),
            std::tuple(0.0, 0.0, 1.0, 0.0, 0u));
  EXPECT_FALSE(lost->paired || lost->assumed);
  EXPECT_EQ(compared(cells_of(rows), processes(1), 0.05).front().a_ms, 0);
  EXPECT_EQ(
      std::count_if(pairs.begin(), pairs.end(), [](const Pair& p) { return p.verdict == Verdict::lost; }), 1);
}

TEST(Compare, AcrossDevicesAndWithinOneSet) {
  const auto a = processes(1), other = processes(1, 0.5, "other device");
  EXPECT_THROW(compared(a, other, 0.05), InputError);
  EXPECT_EQ(compare_cells(a, other, false, CompareBy("device"), {}).size(), 32u);
  const auto layers = compare_cells(a, {}, true, CompareBy("axes.layers"), {});
  ASSERT_EQ(layers.size(), 16u);
  for (const Pair& p : layers) EXPECT_NEAR(p.change, 3, 1e-9) << p.name;
  EXPECT_EQ(compare_cells(a, {}, true, CompareBy("axes.size"), {}).size(), 16u);
  EXPECT_THROW(CompareBy("axes."), InputError);
  EXPECT_THROW(CompareBy("host"), InputError);
}

TEST(Compare, DevicesWithDifferentDefaultMappingsArePaired) {
  std::vector<Cell> tile = processes(3), group = processes(3, 0.5, "another device");
  for (Cell& cell : tile) cell.variant = "opencl+tile";
  for (Cell& cell : group) cell.variant = "opencl+group";
  const auto pairs = compare_cells(tile, group, false, CompareBy("device"), {});
  ASSERT_EQ(pairs.size(), 32u);
  for (const Pair& p : pairs) {
    EXPECT_NEAR(p.change, -0.5, 1e-9) << p.name;
    EXPECT_TRUE(p.name.ends_with(" opencl+tile -> opencl+group")) << p.name;
  }

  // The results of both devices are now in one set. In each pair, `a` must then be the device whose name is
  // first in alphabetical order.
  std::vector<Cell> both = tile;
  both.insert(both.end(), group.begin(), group.end());
  for (const Pair& p : compare_cells(both, {}, true, CompareBy("device"), {})) {
    EXPECT_TRUE(p.a.starts_with("another device")) << p.a;
    EXPECT_TRUE(p.name.ends_with(" opencl+group -> opencl+tile")) << p.name;
  }

  // The second set now contains two cells of the other device for each cell of the first set. The comparison
  // must pair each cell only with the cell of the same variant.
  std::vector<Cell> mixed = group;
  for (const Cell& cell : processes(3, 0.7, "another device")) {
    mixed.push_back(cell);
    mixed.back().variant = "opencl+tile";
  }
  const auto exact = compare_cells(tile, mixed, false, CompareBy("device"), {});
  ASSERT_EQ(exact.size(), 32u);
  for (const Pair& p : exact) EXPECT_NEAR(p.change, -0.3, 1e-9) << p.name;
  mixed.insert(mixed.end(), tile.begin(), tile.end());
  EXPECT_EQ(compare_cells(mixed, {}, true, CompareBy("device"), {}).size(), 32u);
}

TEST(Compare, TwoMeasurementsOfOneNameInASetAreRefused) {
  auto rows = test::table1_rows(), other = test::table1_rows(2);
  for (FoundRow& row : rows) row.row.identity = {{"mesh", "1"}, {"scene", "1111111122222222"}};
  for (FoundRow& row : other) row.row.identity = {{"mesh", "1"}, {"scene", "5555555566666666"}};
  const auto clean = cells_of(rows);
  EXPECT_EQ(compared(clean, cells_of(other), 0.05).size(), 32u);
  rows.insert(rows.end(), other.begin(), other.end());
  const std::string said = test::refusal([&] { compared(cells_of(rows), clean, 0.05); });
  test::expect_has(said, "different inputs (scene)");
}

TEST(Compare, Fractions) {
  EXPECT_DOUBLE_EQ(fraction_from_text("--threshold", "5%"), 0.05);
  EXPECT_DOUBLE_EQ(fraction_from_text("--threshold", "0.1"), 0.1);
  for (const char* text : {"", "five", "-1%", "%", "1%%"})
    EXPECT_THROW(fraction_from_text("--threshold", text), InputError) << text;
}

}  // namespace
}  // namespace pelage
