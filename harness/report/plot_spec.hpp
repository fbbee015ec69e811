// The description of a plot of a table's lines. plots/plot.py draws it.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/experiment/view.hpp"
#include "harness/report/cells.hpp"
#include "harness/table/table.hpp"

namespace pelage {

/// All names are names of the table's columns.
struct PlotSpec {
  std::string title, stem;  ///< the files are plots/STEM.svg, .pdf, .csv, .json and .py
  std::string x, x_label, x_scale = "linear";
  std::string y, y_label, y_scale = "linear";
  std::string low, high;  ///< limits of the interval of y; "" if there is none
  std::vector<std::string> series,
      panels;  ///< each combination of values has its own colour (series) or its own panel (panels)
  /// Numbers of a paper: the columns NAME, NAME_low and NAME_high, drawn as a dashed line. If a number has no
  /// high limit, it is a lower limit of y.
  std::string published, published_label;
  std::optional<double> guide;                            ///< a horizontal line at this value of y
  std::map<std::string, std::vector<std::string>> order;  ///< column -> order of its values
  std::map<std::string, std::string> labels;              ///< column -> text of a value: "{} layers"
  std::string note;                                       ///< small text above the panels: the device
};

/// Returns the plots of a table: one for each y of the view. The key columns are the axes and the variant. If
/// the view names no x, then x is the numeric key column with the most values. A second numeric key column
/// gives the panels, and the other key columns that vary give the series. If there are more than seven
/// series, key columns with few values give panels instead. If the numeric x has only two values and there
/// would be more than seven series, a text column is x. Without a numeric key column, x is the text column
/// with the most values. If the view names no scale, a scale is logarithmic if all values are positive and
/// the largest value is at least 20 times the smallest value. `notes` gets a line for each name in the view
/// that is not a column of the table. A y with fewer than two numbers gives no plot.
std::vector<PlotSpec> plots_of(const Table& table, const std::vector<Cell>& cells, const View& view,
                               std::vector<std::string>& notes);

/// Returns the description as JSON, in the form that plots/plot.py reads.
std::string json_of(const PlotSpec& plot);

}  // namespace pelage
