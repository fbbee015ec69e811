#include "harness/page/chart.hpp"

#include <gtest/gtest.h>

#include "harness/page/study_charts.hpp"

namespace pelage {
namespace {

/// Returns a table with the columns `variant`, `layers`, `median_ms` and `paper`. Further columns contain the
/// lower and the upper limits of `median_ms` and of `paper`. For each value, Value::cell is the index of the
/// value's line in the table.
Table table() {
  Table table;
  table.columns = {{"variant", "variant"},      {"layers", "layers", "{} layers"}, {"median_ms", "ms"},
                   {"median_ms_low", "low"},    {"median_ms_high", "high"},        {"paper", "paper"},
                   {"paper_low", "paper, low"}, {"paper_high", "paper, high"}};
  const std::vector<std::vector<std::string>> lines{{"b", "64", "40", "39", "42", "50", "50", ""},
                                                    {"b", "16", "10", "9", "11", "", "", ""},
                                                    {"a", "16", "5", "", "", "8", "7", "9"},
                                                    {"a", "64", "", "", "", "", "", ""}};
  for (const auto& texts : lines) {
    std::vector<Value> line;
    for (const std::string& text : texts) {
      line.push_back({text, text});
      line.back().cell = int(table.lines.size());
    }
    table.lines.push_back(std::move(line));
  }
  return table;
}

PlotSpec plot() {
  PlotSpec plot;
  plot.x = "layers", plot.y = "median_ms", plot.low = "median_ms_low", plot.high = "median_ms_high";
  plot.series = {"variant"};
  return plot;
}

TEST(Chart, SortsPointsAndLeavesOutMissingNumbers) {
  const Chart chart = chart_of(table(), plot());
  ASSERT_EQ(chart.panels.size(), 1u);
  ASSERT_EQ(chart.panels[0].lines.size(), 2u);
  const ChartLine& a = chart.panels[0].lines[0];
  const ChartLine& b = chart.panels[0].lines[1];
  EXPECT_EQ(a.label, "a");
  ASSERT_EQ(a.points.size(), 1u);
  EXPECT_FALSE(a.points[0].low);
  ASSERT_EQ(b.points.size(), 2u);
  EXPECT_EQ(b.points[0].x, 16);
  EXPECT_EQ(b.points[0].cell, 1);
  EXPECT_EQ(b.points[1].y, 40);
  EXPECT_EQ(b.points[1].high, 42);
  EXPECT_EQ(b.mark, Mark::line);
}

TEST(Chart, PanelsAndCategories) {
  PlotSpec spec = plot();
  spec.x = "variant", spec.series = {}, spec.panels = {"layers"};
  const Chart chart = chart_of(table(), spec);
  EXPECT_EQ(chart.categories, (std::vector<std::string>{"b", "a"}));
  ASSERT_EQ(chart.panels.size(), 2u);
  EXPECT_EQ(chart.panels[0].title, "16 layers");
  ASSERT_EQ(chart.panels[0].lines.size(), 1u);
  EXPECT_EQ(chart.panels[0].lines[0].mark, Mark::points);
  EXPECT_EQ(chart.panels[0].lines[0].points.size(), 2u);
}

/// Published numbers are drawn as separate lines. If a published number is only a lower bound, such as ">
/// 50", the error bar of its point has a lower limit and no upper limit.
TEST(Chart, PublishedNumbersAreLinesOfTheirOwn) {
  PlotSpec spec = plot();
  spec.published = "paper", spec.published_label = "the paper";
  const Chart chart = chart_of(table(), spec);
  ASSERT_EQ(chart.panels.size(), 1u);
  std::vector<std::string> labels;
  for (const ChartLine& line : chart.panels[0].lines) labels.push_back(line.label);
  EXPECT_EQ(labels, (std::vector<std::string>{"ours, a", "the paper, a", "ours, b", "the paper, b"}));
  const ChartLine& limit = chart.panels[0].lines[3];
  EXPECT_EQ(limit.mark, Mark::published);
  EXPECT_EQ(limit.points[0].low, 50);
  EXPECT_FALSE(limit.points[0].high);
  EXPECT_EQ(limit.key, chart.panels[0].lines[2].key);
}

/// If several points have the same x, no line joins the points, because their order has no meaning.
TEST(Chart, PointsWithTheSameXAreNotJoined) {
  PlotSpec spec = plot();
  spec.series = {};
  const Chart chart = chart_of(table(), spec);
  ASSERT_EQ(chart.panels.size(), 1u);
  EXPECT_EQ(chart.panels[0].lines[0].mark, Mark::points);
}

TEST(Chart, JsonHasEveryPoint) {
  const auto json = json_of(chart_of(table(), plot()));
  EXPECT_EQ(json["panels"][0]["lines"][1]["points"][1].dump(), "[64.0,40.0,39.0,42.0,0]");
  EXPECT_EQ(json["panels"][0]["lines"][0]["points"][0].dump(), "[16.0,5.0,null,null,2]");
}

Cell study_cell(const std::string& experiment, const std::string& topology, double ms) {
  Cell cell;
  cell.experiment = experiment, cell.device = "device", cell.variant = "rk4";
  cell.axes = {{"dynamics.topology", topology}, {"model", "torus"}, {"reading", "k100"}};
  cell.median_ms = ms;
  return cell;
}

TEST(Chart, EveryStudyHasItsPoints) {
  std::vector<Cell> cells;
  for (const char* name : {"update-time", "work-precision", "longest-step", "energy", "mesh-size"}) {
    Cell cell = study_cell(std::string("banisch2006-") + name, "prisms", 2);
    cell.metrics = {{"error_rms", {0.5, ""}},
                    {"longest_step_ms", {3, "ms"}},
                    {"triangles", {8, ""}},
                    {"energy_uJ_at_0.5", {9, "uJ"}},
                    {"paper_fps", {100, "fps"}}};
    cell.phase_ms["simulate"] = 1;
    cells.push_back(cell);
    cell.status = Status::error;
    cells.push_back(cell);
  }
  const std::vector<Chart> charts = spring_charts(cells);
  ASSERT_EQ(charts.size(), 5u);
  for (const Chart& chart : charts) {
    ASSERT_EQ(chart.panels.size(), 1u) << chart.title;
    for (const ChartLine& line : chart.panels[0].lines) EXPECT_EQ(line.points.size(), 1u) << chart.title;
  }
  EXPECT_EQ(charts[3].panels[0].lines.size(), 3u) << "frame, simulation and the paper's frame";
  EXPECT_EQ(charts[1].panels[0].lines[0].points[0].x, 100) << "the stiffness in the reading k100";
}

TEST(Chart, ScalingHasAPanelForEachQuantityThatVaries) {
  std::vector<Cell> cells;
  for (const char* layers : {"16", "64"})
    for (const char* size : {"320x240", "800x600"}) {
      Cell cell = study_cell("scaling", "", 2);
      cell.axes = {{"layers", layers}, {"size", size}};
      cell.metrics = {{"triangles", {9000, ""}}};
      cells.push_back(cell);
    }
  const Chart chart = scaling_chart(cells);
  ASSERT_EQ(chart.panels.size(), 2u);
  EXPECT_EQ(chart.panels[0].x_label, "layers");
  EXPECT_EQ(chart.panels[1].lines.size(), 2u);
  EXPECT_TRUE(scaling_chart({}).panels.empty());
}

}  // namespace
}  // namespace pelage
