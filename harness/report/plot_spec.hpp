// Describes which columns of a table a plot shows, and how. plots/plot.py draws the plot.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/experiment/view.hpp"
#include "harness/report/cells.hpp"
#include "harness/table/table.hpp"

namespace pelage {

/// x, y, low, high, series, panels and published are names of columns of the table.
struct PlotSpec {
  std::string title, stem;  ///< STEM of the plot's files plots/STEM.svg, .pdf, .csv, .json and .py
  std::string x, x_label, x_scale = "linear";
  std::string y, y_label, y_scale = "linear";
  std::string low, high;  ///< columns with the limits of the interval of y; "" if there are none
  std::vector<std::string> series,
      panels;  ///< each combination of values is a line (series) or a panel (panels)
  /// Column with numbers that a paper published. They are drawn as a dashed line. The columns NAME_low and
  /// NAME_high contain their limits. If a number has a lower limit but no upper limit, it is drawn as a lower
  /// limit of y.
  std::string published, published_label;
  std::optional<double> guide;                            ///< y of a horizontal reference line
  std::map<std::string, std::vector<std::string>> order;  ///< column -> its values in order
  std::map<std::string, std::string> labels;              ///< column -> format of its values: "{} layers"
  std::string note;                                       ///< text above the panels, such as the device
};

/// Returns the plots of a table: one plot for each y of the view. A y with fewer than two numbers gets no
/// plot. If the view names no x, x is the numeric key column (axis or variant) with the most values. A second
/// numeric key column gives the panels, and the other key columns that vary give the series. If there are
/// more than seven series, the key columns with the fewest values give panels instead. x is the text key
/// column with the most values if there is no numeric key column. It is also a text column if the numeric
/// column has only two values and there would be more than seven series. If the view names no scale, a scale
/// is logarithmic if all values are positive and the largest is at least 20 times the smallest. For each name
/// in the view that is not a column of the table, a line is added to `notes`.
std::vector<PlotSpec> plots_of(const Table& table, const std::vector<Cell>& cells, const View& view,
                               std::vector<std::string>& notes);

/// Returns the description as JSON for plots/plot.py.
std::string json_of(const PlotSpec& plot);

}  // namespace pelage
