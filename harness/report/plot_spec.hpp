// Describes which columns of a table a plot shows, and how. plots/plot.py draws the plot: every report
// contains small Python programs (matplotlib) beside their data.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/experiment/view.hpp"
#include "harness/report/cells.hpp"
#include "harness/table/table.hpp"

namespace pelage {

/// `x`, `y`, `low`, `high`, `series`, `panels` and `published` are names of columns of the table.
struct PlotSpec {
  std::string title, stem;  ///< STEM of the plot's files plots/STEM.svg, .pdf, .csv, .json and .py
  std::string x, x_label, x_scale = "linear";
  std::string y, y_label, y_scale = "linear";
  std::string low, high;  ///< columns with the limits of the interval of y; "" if there are none
  /// Each combination of values of `panels` has its own panel, and in it each combination of values of
  /// `series` a line.
  std::vector<std::string> series, panels;
  /// Column with numbers that a paper published, drawn as a dashed line. The columns NAME_low and NAME_high
  /// contain their limits. A number with a lower limit but no upper limit is drawn as a lower limit of y.
  std::string published, published_label;
  bool bars = false;                                      ///< bars instead of points, if x has categories
  std::optional<double> guide;                            ///< y of a horizontal reference line
  std::vector<double> limits;                             ///< y of dotted lines
  std::map<std::string, std::vector<std::string>> order;  ///< column -> its values in order
  std::map<std::string, std::string> labels;              ///< column -> format of its values: "{} layers"
  std::string note;                                       ///< text above the panels, such as the device
};

/// Returns the plots of a table: one plot for each y of the view with at least two numbers; none without a
/// view for cells with the axis "figure". If x of the view has only one value, the series column with the
/// most values becomes x, or else the key column (axis or variant) with the most values.
///
/// If the view names no x, the numeric key column with the most values becomes x. A second numeric key column
/// gives the panels, and the other key columns give the series. The text key column with the most values
/// becomes x if there is no numeric key column, or if each of them has only two values and the text key
/// columns would give more than seven series. If more than seven series remain, the key columns with the
/// fewest values give panels in place of series.
///
/// If the view names no scale, a scale is logarithmic if all values are positive and the largest is at least
/// 20 times the smallest. For each name in the view that is not a column of the table, a line is added to
/// `notes`.
std::vector<PlotSpec> plots_of(const Table& table, const std::vector<Cell>& cells, const View& view,
                               std::vector<std::string>& notes);

/// Returns the description as JSON for plots/plot.py.
std::string json_of(const PlotSpec& plot);

/// Returns the path of the plot program plots/NAME.py. Throws InputError if it is not installed.
std::filesystem::path plot_program(const std::string& name);

/// Runs `program table stem.svg stem.pdf` with /usr/bin/python3, or else the python3 on PATH. Returns "" if
/// the program wrote the pictures, else one line with the reason.
std::string draw_plot(const std::filesystem::path& program, const std::filesystem::path& table,
                      const std::filesystem::path& stem);

}  // namespace pelage
