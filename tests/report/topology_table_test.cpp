// Tests the table of the cost of each topology. The rows have synthetic times.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/experiment/experiment.hpp"
#include "harness/report/report.hpp"

namespace pelage {
namespace {

/// Returns one row for every case of topology-table1.toml. A frame takes 10 ms plus its simulation, which
/// takes 0 to 4 ms depending on the topology.
std::vector<FoundRow> sweep_rows() {
  const Experiment e =
      read_experiment(std::filesystem::path(PELAGE_SOURCE_DIR) / "experiments/topology-table1.toml");
  const std::map<std::string, double> cost{
      {"silva", 0}, {"sticks", 1}, {"prisms", 2}, {"separable-sticks", 3}, {"separable-prisms", 4}};
  std::vector<FoundRow> rows;
  for (const Case& c : cases_of(e, preset_of(e, "quick"))) {
    Row row;
    row.run_id = "run";
    row.experiment = e.name;
    row.case_name = c.name;
    row.variant = c.variant;
    row.axes = c.axes;
    row.device = "test device";
    const double simulate = cost.at(c.axes.at("dynamics.topology"));
    for (int i = 0; i < 11; ++i) {
      row.samples["frame"].wall_ms.push_back(10 + simulate + 0.001 * (i - 5));
      row.samples["simulate"].event_ms.push_back(simulate);
      row.samples["raster"].event_ms.push_back(9);
    }
    row.metrics["triangles"] = {c.axes.at("model") == "torus" ? 9360.0 : 20000.0, "triangles"};
    row.metrics["masses"] = {12, "masses"};
    row.provenance = {{"host", "h"}, {"converged", true}};
    rows.push_back({row, "results/topology-table1/test_device@h.jsonl"});
  }
  return rows;
}

TEST(TopologyTable, HasA160CellsAndComparesThemWithSilvasStrand) {
  const std::vector<FoundRow> rows = sweep_rows();
  ASSERT_EQ(rows.size(), 160u);
  const auto tables = topology_tables(rows);
  ASSERT_EQ(tables.size(), 1u);
  const TopologyTable& table = tables[0];
  EXPECT_EQ(table.topologies.front(), "silva");
  ASSERT_EQ(table.topologies.size(), 5u);
  ASSERT_EQ(table.rows.size(), 32u);
  EXPECT_EQ(table.rows.front().model, "torus");
  EXPECT_EQ(table.rows.front().layers, "16");
  EXPECT_EQ(table.rows.back().layers, "64");
  for (const TopologyTable::Row& row : table.rows)
    for (std::size_t t = 0; t < 5; ++t) {
      ASSERT_TRUE(row.entries[t]);
      EXPECT_NEAR(*row.entries[t]->ratio, (10 + double(t)) / 10, 1e-6);
      EXPECT_NEAR(*row.entries[t]->simulate_ms, double(t), 1e-12);
      EXPECT_NEAR(*row.entries[t]->raster_ms, 9, 1e-12);
    }
  EXPECT_NEAR(*table.summary[4].ratio, 1.4, 1e-6);
  EXPECT_NEAR(*table.summary[4].simulate, 4.0 / 14, 1e-6);
  const std::string csv = csv_of(table);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 161);
  for (const std::string& text : {text_of(table), latex_of(table), html_of(table)})
    EXPECT_NE(text.find("separable-prisms"), std::string::npos);
}

TEST(TopologyTable, IsNoneOfThePapersTablesAndTellsWhatHasNoTime) {
  std::vector<FoundRow> rows = sweep_rows();
  EXPECT_TRUE(paper_tables(cells_of(rows), [](const std::string&) { return std::string(); }).empty());
  rows[0].row.status = Status::diverged;
  rows[0].row.samples.clear();
  const TopologyTable table = topology_tables(rows)[0];
  EXPECT_NE(text_of(table).find("diverged"), std::string::npos);
  EXPECT_FALSE(
      table.rows.front().entries[1]->ratio);  // no ratio, because the row's first topology has no time
  rows[0].row.overrides["fur.length"] = "0.1";
  EXPECT_FALSE(topology_tables(rows)[0].rows.front().entries[0]);
}

}  // namespace
}  // namespace pelage
