// The cross table that readers see: the lines of a table arranged by its layout. All renderers show the same
// cross table.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/table/table.hpp"

namespace pelage {

struct Pivot {
  struct Row {
    std::vector<Value> keys;                  ///< one per key column
    std::vector<std::optional<Value>> cells;  ///< groups x values; empty where no line has the place
  };
  struct Block {
    std::vector<std::string> label;  ///< one part per column of Layout::blocks: "16 layers"
    std::vector<Row> rows;
  };
  std::vector<Column> keys;  ///< one without a heading if the layout has no rows
  std::vector<Column> values;
  std::vector<std::vector<std::string>>
      groups;                 ///< labels; one group without a label if the layout has no groups
  std::vector<Block> blocks;  ///< one block without a label if the layout has no blocks
};

/// Arranges the lines. Every line is shown: if two lines have the same place, the second line gets a row of
/// its own.
Pivot pivot_of(const Table& table);

/// Returns the parts joined by ", ".
std::string joined(const std::vector<std::string>& parts);

}  // namespace pelage
