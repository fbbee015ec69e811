// The cross table that readers see: the lines of a table, arranged by the table's layout. The renderers for
// text, LaTeX and HTML show the same cross table.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/table/table.hpp"

namespace pelage {

struct Pivot {
  struct Row {
    std::vector<Value> keys;                  ///< one per key column
    std::vector<std::optional<Value>> cells;  ///< groups x values; empty if no line belongs there
  };
  struct Block {
    std::vector<std::string> label;  ///< one part per column of Layout::blocks: "16 layers"
    std::vector<Row> rows;
  };
  std::vector<Column> keys;  ///< if the layout has no rows: one column without a heading
  std::vector<Column> values;
  std::vector<std::vector<std::string>>
      groups;                 ///< labels; if the layout has no groups: one group without a label
  std::vector<Block> blocks;  ///< if the layout has no blocks: one block without a label
};

/// Arranges the lines. Every line is shown: if two lines have the same place, the second line gets a separate
/// row.
Pivot pivot_of(const Table& table);

/// Returns the parts joined by ", ".
std::string joined(const std::vector<std::string>& parts);

}  // namespace pelage
