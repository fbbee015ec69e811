// A table of the variants of an experiment that should draw the same picture. Such variants are called ways.
// The table shows which variant is fastest and which variants draw a different picture.
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
    double fastest_ms = 0;  ///< shortest median time of an ok cell in the column; 0 without an ok cell
  };
  struct Row {
    std::string way;
    /// Geometric mean, over the row's cells with status ok, of the cell's frame time divided by fastest_ms of
    /// the cell's column.
    double times = 0;
    std::vector<std::optional<Cell>> entries;  ///< one per column
  };
  std::string experiment, device, host;
  std::vector<Column> columns;  ///< sorted by model, layers and size
  std::vector<Row> rows;        ///< sorted by speed, the fastest first; variants without a time are last
};

/// Smallest number of variants for which the results of an experiment become a WayTable instead of a
/// PaperTable.
constexpr std::size_t fewest_ways = 4;

/// Returns true if the report shows the results of the cell's experiment as a WayTable. Such an experiment
/// has at least `fewest_ways` variants and the axes model, layers and size. Its cells have no number from a
/// paper, no opengl_ratio and no axis dynamics.topology.
bool has_ways(const std::vector<Cell>& cells, const Cell& cell);

/// Returns one table per device and host for each experiment for which has_ways() is true. Only cells without
/// overrides are used.
std::vector<WayTable> way_tables(const std::vector<Cell>& cells);

std::string text_of(const WayTable& table);
/// Returns CSV with one line per cell of the table.
std::string csv_of(const WayTable& table);
std::string html_of(const WayTable& table);

}  // namespace pelage
