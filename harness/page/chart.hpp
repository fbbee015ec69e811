// Charts of the report's page: the points of a plot with their labels. harness/page/web/charts.js draws them.
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "harness/report/plot_spec.hpp"
#include "harness/table/table.hpp"

namespace pelage {

struct ChartPoint {
  double x = 0, y = 0;                        ///< if the chart has categories, x is the index of a category
  std::optional<double> low = {}, high = {};  ///< limits of the interval of y
  int cell = -1;                              ///< index of the cell (Cell::index); -1 if the point has none
};

enum class Mark {
  points,    ///< separate points
  line,      ///< points that are joined by a line
  published  ///< numbers of a paper: points that are joined by a dashed line
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
  std::string stem = {};  ///< the chart's name in the page; unique in a report
  std::string x_label = {}, x_scale = "linear", y_label = {}, y_scale = "linear";
  std::vector<std::string> categories = {};  ///< names of the values of x; empty if x is a number
  std::optional<double> guide = {};          ///< a horizontal line at this value of y
  std::vector<ChartPanel> panels = {};
};

/// Returns the chart of a table's plot. Each combination of values of the columns PlotSpec::panels has a
/// panel, and each combination of values of the columns PlotSpec::series has a line with the same label in
/// every panel. Lines without a point are left out. Points that share an x are not joined.
Chart chart_of(const Table& table, const PlotSpec& plot);

/// Returns the chart as JSON, in the form that web/charts.js reads.
nlohmann::ordered_json json_of(const Chart& chart);

}  // namespace pelage
