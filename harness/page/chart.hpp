// Charts of the HTML report: the panels, lines and points of each plot, and their labels.
// harness/page/web/charts.js draws them. A cell is the combined result of one case
// (harness/report/cells.hpp).
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "harness/report/plot_spec.hpp"
#include "harness/table/table.hpp"

namespace pelage {

struct ChartPoint {
  double x = 0, y = 0;  ///< if Chart::categories is not empty, x is an index of this list
  std::optional<double> low = {}, high = {};  ///< limits of the error bar of y
  int cell = -1;  ///< Cell::index of the cell whose value the point shows; -1 if there is no cell
};

enum class Mark {
  points,    ///< separate points
  line,      ///< points joined by a line
  published  ///< numbers that a paper published: points joined by a dashed line
};

struct ChartLine {
  std::string label;
  std::string key;  ///< lines with the same key have the same colour
  Mark mark = Mark::line;
  std::vector<ChartPoint> points;
};

struct ChartPanel {
  std::string title;
  std::string x_label;  ///< replaces Chart::x_label if it is not empty
  std::vector<ChartLine> lines;
};

struct Chart {
  std::string title = {}, note = {};
  std::string stem = {};  ///< name of the chart and of its files; unique in a report
  std::string x_label = {}, x_scale = "linear", y_label = {}, y_scale = "linear";
  std::vector<std::string> categories = {};  ///< labels of the x axis if x is not numeric; else empty
  std::optional<double> guide = {};          ///< y of a horizontal reference line
  std::vector<ChartPanel> panels = {};
};

/// Computes the chart that `plot` describes. Its points come from the lines of the table. The chart has one
/// panel for each combination of values of the columns PlotSpec::panels. Each panel has one chart line for
/// each combination of values of the columns PlotSpec::series. Chart lines without a point are left out. If
/// several points of a chart line have the same x, its points are not joined.
Chart chart_of(const Table& table, const PlotSpec& plot);

/// Returns the chart as JSON for web/charts.js.
nlohmann::ordered_json json_of(const Chart& chart);

}  // namespace pelage
