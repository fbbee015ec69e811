// A table of the variants of one experiment. All variants should draw the same picture; the code calls them
// ways. The table shows which variant is fastest and which variants draw a different picture.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/report/cells.hpp"

namespace pelage {

/// The table has one row per variant, and one column per combination of model, number of layers and picture
/// size.
struct WayTable {
  struct Column {
    std::string model, layers, size;
    /// Shortest median frame time of the column's cells with status ok; 0 if no cell has this status.
    double fastest_ms = 0;
  };
  struct Row {
    std::string way;
    /// Geometric mean of the ratios t / fastest_ms over the row's cells with status ok. t is the median frame
    /// time of a cell, and fastest_ms is that of the cell's column.
    double times = 0;
    std::vector<std::optional<Cell>> entries;  ///< one per column
  };
  std::string experiment, device, host;
  std::vector<Column> columns;  ///< sorted by model, layers and size
  std::vector<Row> rows;        ///< sorted by speed, the fastest first; variants without a time are last
};

/// If an experiment has at least this number of variants, the report may show its results as a WayTable (one
/// row per variant); see has_ways().
constexpr std::size_t fewest_ways = 4;

/// Returns true if the report shows the results of the cell's experiment as a WayTable (one row per variant).
/// Such an experiment has at least `fewest_ways` variants. It has the axes model, layers and size, but not
/// the axis dynamics.topology. No cell of the experiment has a frame rate printed in a paper or the metric
/// opengl_ratio.
bool has_ways(const std::vector<Cell>& cells, const Cell& cell);

/// Returns one table per device and host for each experiment for which has_ways() is true. The function
/// omits cells whose case was changed on the command line (--set, --axis, --model).
std::vector<WayTable> way_tables(const std::vector<Cell>& cells);

std::string text_of(const WayTable& table);
/// Returns CSV with one line per cell of the table.
std::string csv_of(const WayTable& table);
std::string html_of(const WayTable& table);

}  // namespace pelage
