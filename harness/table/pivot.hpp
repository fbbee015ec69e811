// Arranges the lines of a table as the cross table that Table::layout defines.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/table/table.hpp"

namespace pelage {

struct Pivot {
  struct Row {
    std::vector<Value> keys;                  ///< one value for each column in Pivot::keys
    std::vector<std::optional<Value>> cells;  ///< for each group, one cell for each column in Pivot::values;
                                              ///< std::nullopt if no line belongs in the cell
  };
  struct Block {
    std::vector<std::string> label;  ///< heading: one text per column of Layout::blocks, such as "16 layers"
    std::vector<Row> rows;
  };
  std::vector<Column> keys;  ///< columns of Layout::rows; if there are none, one column without a heading
  std::vector<Column> values;
  std::vector<std::vector<std::string>>
      groups;  ///< headings of the groups; one group without a heading if Layout::groups is empty
  std::vector<Block> blocks;  ///< one block without a heading if Layout::blocks is empty
};

/// If two lines belong in the same cells, the second line gets a separate row.
Pivot pivot_of(const Table& table);

/// Joins the parts with ", ".
std::string joined(const std::vector<std::string>& parts);

}  // namespace pelage
