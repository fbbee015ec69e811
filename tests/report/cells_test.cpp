#include "harness/report/cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/claims/judge.hpp"
#include "harness/error.hpp"
#include "tests/report/rows.hpp"

namespace pelage {
namespace {

const Cell& named(const std::vector<Cell>& cells, const std::string& name) {
  return *std::find_if(cells.begin(), cells.end(), [&](const Cell& c) { return c.case_name == name; });
}

TEST(Cells, MedianAndFrameRate) {
  const auto cells = cells_of(test::table1_rows());
  ASSERT_EQ(cells.size(), 32u);
  const Cell& torus = named(cells, "torus-16-800x600");
  EXPECT_NEAR(torus.median_ms, (9360 + 480000) * 16 / 1e6, 1e-9);
  EXPECT_NEAR(torus.fps(), 1000 / torus.median_ms, 1e-12);
  EXPECT_LT(torus.interval_ms.low, torus.median_ms);
  EXPECT_GT(torus.interval_ms.high, torus.median_ms);
}

TEST(Cells, ProcessesOfOneCaseAreOneCell) {
  auto rows = test::table1_rows();
  auto slower = test::table1_rows(2);
  for (FoundRow& row : slower) row.row.repeat = 1;
  rows.insert(rows.end(), slower.begin(), slower.end());
  const auto cells = cells_of(rows);
  ASSERT_EQ(cells.size(), 32u);
  const Cell& torus = named(cells, "torus-16-800x600");
  EXPECT_EQ(torus.timings.processes.size(), 2u);
  // The times of the two processes differ by a factor of two. The 95% interval must contain the times of
  // both.
  EXPECT_GT(torus.interval_ms.high / torus.interval_ms.low, 1.9);
}

TEST(Cells, AnyPhaseCanTakeThePlaceOfTheFrame) {
  std::vector<FoundRow> rows = {test::table1_rows()[0], test::table1_rows()[1]};
  rows[0].row.samples["raster"] = {{4, 5, 6}, {}};  // event times
  rows[1].row.samples["raster"] = {{}, {7, 8, 9}};  // only wall times
  rows[0].row.samples["simulate"] = {{1, 1, 1}, {}};
  std::vector<Cell> cells = cells_of(rows), simulation = cells;
  use_phase(cells, rows, "raster");
  EXPECT_EQ(cells[0].median_ms, 5);
  EXPECT_EQ(cells[0].timings.processes, (std::vector<std::vector<double>>{{4, 5, 6}}));
  EXPECT_EQ(cells[1].median_ms, 8);
  use_phase(simulation, rows, "simulate");
  EXPECT_EQ(simulation[0].median_ms, 1);
  EXPECT_EQ(simulation[1].median_ms, 0) << "a cell without the phase has no time";
  EXPECT_THROW(use_phase(cells, rows, "bake"), InputError);
}

// The wall time is the time that counts. Only a phase without wall times has event times in a table or claim.
TEST(Cells, AndClaimsTakeTheSameTimesOfAPhase) {
  FoundRow both = test::own_rows({{"mood", {"dry"}}}).front(), within = both;
  both.row.samples["nest"] = {{1, 1, 1, 1, 1, 1}, {2, 2, 2, 2, 2, 2}};
  within.row.samples["nest"] = {{1, 1, 1, 1, 1, 1}, {}};
  const auto claimed = [](const FoundRow& found) {
    claims::Claim claim;
    claim.experiments = {found.row.experiment};
    claim.quantity = claims::Quantity::phase_time;
    claim.phase = "nest";
    claim.region.high = 100;
    claims::ClaimFile file;
    file.claims = {claim};
    return claims::judge(file, {found}).front().value;
  };
  for (const auto& [found, ms] : {std::pair(both, 2.0), std::pair(within, 1.0)}) {
    std::vector<Cell> cells = cells_of({found});
    EXPECT_EQ(cells.front().phase_ms.at("nest"), ms);
    use_phase(cells, {found}, "nest");
    EXPECT_EQ(cells.front().median_ms, ms);
    EXPECT_EQ(claimed(found), ms);
  }
}

TEST(Cells, MetricsOfSeveralProcessesAreCombined) {
  std::vector<FoundRow> rows;
  for (const double value : {8.0, 10.0, 9.0}) {
    FoundRow row = test::table1_rows().front();
    row.row.repeat = int(rows.size());
    row.row.metrics["opengl_ratio"] = {value, "times", "", value - 0.5, value + 0.5};
    rows.push_back(row);
  }
  const Cell two = cells_of({rows[0], rows[1]}).front(), three = cells_of(rows).front();
  EXPECT_EQ(two.metrics.at("opengl_ratio").value, 9);
  EXPECT_EQ(two.metrics.at("opengl_ratio").low, 7.5);
  EXPECT_EQ(two.metrics.at("opengl_ratio").high, 10.5);
  // 4.3027 is the quantile of Student's t for two degrees of freedom. 0.11165 is the standard deviation of
  // the logarithms of 8, 10 and 9.
  const Metric& ratio = three.metrics.at("opengl_ratio");
  EXPECT_EQ(ratio.value, 9);
  EXPECT_NEAR(*ratio.low, std::exp(std::log(720.0) / 3 - 4.3027 * 0.11165 / std::sqrt(3.0)), 1e-3);
  EXPECT_NEAR(*ratio.high, std::exp(std::log(720.0) / 3 + 4.3027 * 0.11165 / std::sqrt(3.0)), 1e-3);
  EXPECT_EQ(three.runs.at("opengl_ratio"), (std::vector<double>{8, 10, 9}));
  EXPECT_EQ(three.metrics.at("paper_fps").relation, rows[0].row.metrics.at("paper_fps").relation);
}

TEST(Cells, KnowWhetherTheMedianIsPreciseAndTheTimesDrift) {
  FoundRow row = test::table1_rows().front();
  EXPECT_TRUE(cells_of({row}).front().converged);
  EXPECT_EQ(cells_of({row}).front().drift, 0);
  auto& times = row.row.samples["frame"].wall_ms;
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = 10 + 0.1 * double(i);
  EXPECT_FALSE(cells_of({row}).front().converged);
  EXPECT_NEAR(cells_of({row}).front().drift, 2.0 / 11, 1e-9);
  row.row.provenance["precision"] = relative_half_width(times);
  EXPECT_TRUE(cells_of({row}).front().converged);
  times.resize(5);  // too few for a 95% interval
  EXPECT_FALSE(cells_of({row}).front().converged);
}

TEST(Cells, OneBadRowSpoilsItsCell) {
  auto rows = test::table1_rows();
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
  const auto cells = cells_of(test::table1_rows(0.1));
  const Cell& torus = named(cells, "torus-16-800x600");
  const Ratio r = *ratio_of(torus);
  EXPECT_NEAR(r.value, torus.fps() / 267, 1e-12);
  EXPECT_NEAR(*r.low, 1000 / torus.interval_ms.high / 267.5, 1e-12);
  EXPECT_NEAR(*r.high, 1000 / torus.interval_ms.low / 266.5, 1e-12);
}

TEST(Cells, ACensoredFigureBoundsTheRatioFromBelowOnly) {
  const Ratio r = *ratio_of(named(cells_of(test::table1_rows()), "lion-64-800x600"));
  EXPECT_EQ(r.relation, ">");
  EXPECT_TRUE(r.low);
  EXPECT_FALSE(r.high);
}

}  // namespace
}  // namespace pelage
