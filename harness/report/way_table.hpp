// A table of ways: an experiment's variants that draw the same picture. It shows which variant is fastest and
// which draws another picture.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/report/cells.hpp"

namespace pelage {

/// One row per way, one column per model x layers x size.
struct WayTable {
  struct Column {
    std::string model, layers, size;
    double fastest_ms = 0;  ///< of the ok cells; 0 without one
  };
  struct Row {
    std::string way;
    double times = 0;  ///< geometric mean of time over the fastest way's time, over its ok cells
    std::vector<std::optional<Cell>> entries;  ///< per column
  };
  std::string experiment, device, host;
  std::vector<Column> columns;  ///< by model, layers, size
  std::vector<Row> rows;        ///< sorted by speed, the fastest first; ways without a time last
};

/// An experiment with at least this many variants becomes a table of ways, not a table beside a paper's.
constexpr std::size_t fewest_ways = 4;

/// Returns true if the cell's experiment becomes a table of ways: many variants of cells with model, layers
/// and size, and no cell with a paper's figure, a ratio or a topology.
bool has_ways(const std::vector<Cell>& cells, const Cell& cell);

/// Returns one table per such experiment, device and host, from the cells without overrides.
std::vector<WayTable> way_tables(const std::vector<Cell>& cells);

std::string text_of(const WayTable& table);
/// Returns one line per cell.
std::string csv_of(const WayTable& table);
std::string html_of(const WayTable& table);

}  // namespace pelage
