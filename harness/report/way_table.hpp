// Ways to draw the same picture (an experiment's variants) beside each other: which is fastest, and which
// draws another picture.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/report/cells.hpp"

namespace pelage {

/// Rows of ways, columns of model x layers x size.
struct WayTable {
  struct Column {
    std::string model, layers, size;
    double fastest_ms = 0;  ///< of those that are ok; 0 when none is
  };
  struct Row {
    std::string way;
    double times = 0;                          ///< geometric mean of time by the fastest's, over its ok cells
    std::vector<std::optional<Cell>> entries;  ///< per column
  };
  std::string experiment, device, host;
  std::vector<Column> columns;  ///< by model, layers, size
  std::vector<Row> rows;        ///< the fastest first, those without any time last
};

/// Experiments of at least this many variants are tables of ways instead of tables beside a paper's.
constexpr std::size_t fewest_ways = 4;

/// Whether the experiment that the cell belongs to is shown as a table of ways: many variants of cells of
/// model, layers and size, none of them with a paper's figure, a ratio or a topology.
bool has_ways(const std::vector<Cell>& cells, const Cell& cell);

/// One table per such experiment, device and host, out of the cells that are the experiment's own (no
/// overrides).
std::vector<WayTable> way_tables(const std::vector<Cell>& cells);

std::string text_of(const WayTable& table);
/// One line per cell.
std::string csv_of(const WayTable& table);
std::string html_of(const WayTable& table);

}  // namespace pelage
