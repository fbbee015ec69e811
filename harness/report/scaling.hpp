// Text and tables of the experiments on more layers, pixels and triangles: the time ratios of cases with more
// layers, the memory of the cases, and the table to which plots/scaling.py fits its model.
#pragma once
#include <string>
#include <vector>

#include "harness/report/cells.hpp"

namespace pelage {

/// Returns the cells of the experiment "scaling" without overrides that have a time, a triangle count, a
/// number of layers and a picture size.
std::vector<Cell> scaling_cells(const std::vector<Cell>& cells);

/// Returns one line per cell, for programs and for plots/scaling.py.
std::string scaling_csv(const std::vector<Cell>& cells);

/// Returns text for a terminal: the time ratios of cases that differ only in their number of layers, and the
/// largest memory.
std::string scaling_text(const std::vector<Cell>& cells);

/// Returns the ok cells with the metrics half_ratio and quarter_ratio (harness/subjects/fewer_layers.hpp).
std::vector<Cell> in_turns_cells(const std::vector<Cell>& cells);

/// Returns CSV with one line per cell of in_turns_cells(): the two ratios with their intervals.
std::string in_turns_csv(const std::vector<Cell>& cells);

/// Returns the same ratios as text for a terminal, and the largest ratios.
std::string in_turns_text(const std::vector<Cell>& cells);

}  // namespace pelage
