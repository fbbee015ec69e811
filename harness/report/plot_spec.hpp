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
      panels;  ///< lines that differ in them have another colour, or another panel
  /// Numbers of a paper: the columns NAME, NAME_low and NAME_high; drawn dashed. A number without
  /// a high limit is a lower limit of y.
  std::string published, published_label;
  std::optional<double> guide;                            ///< a horizontal line at this value of y
  std::map<std::string, std::vector<std::string>> order;  ///< column -> order of its values
  std::map<std::string, std::string> labels;              ///< column -> how a value reads: "{} layers"
  std::string note;                                       ///< small text above the panels: the device
};

/// Returns the plots of a table. If the view names no x, then x is the numeric key column with the most
/// values. A second numeric key column gives the panels, and the other key columns that vary give the series.
/// If there are more than seven series, key columns with few values give panels instead, and a text column
/// replaces an x with two values. Without a numeric key column, x is the text column with the most values.
/// The scales are logarithmic if the largest value is at least 20 times the smallest one, and all values are
/// positive. `notes` gets a line for each name of the view that is no column of the table. Returns no plot if
/// the table has fewer than two lines with a number.
std::vector<PlotSpec> plots_of(const Table& table, const std::vector<Cell>& cells, const View& view,
                               std::vector<std::string>& notes);

/// Returns the description as JSON, in the form that plots/plot.py reads.
std::string json_of(const PlotSpec& plot);

}  // namespace pelage
