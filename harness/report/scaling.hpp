// Results of the experiment "scaling": the cost of doubling the layers, the memory of the cases, and the
// table to which plots/scaling.py fits its model.
#pragma once
#include <string>
#include <vector>

#include "harness/report/cells.hpp"

namespace pelage {

/// Returns the cells of that experiment without overrides that have a time, a triangle count, layers and a
/// size.
std::vector<Cell> scaling_cells(const std::vector<Cell>& cells);

/// Returns one line per cell, for programs and for plots/scaling.py.
std::string scaling_csv(const std::vector<Cell>& cells);

/// Returns text for a terminal: the cost of twice and four times the layers of the same case, and the largest
/// memory.
std::string scaling_text(const std::vector<Cell>& cells);

/// Returns the ok cells of any experiment that were drawn in turns with half and a quarter of their layers
/// (harness/subjects/fewer_layers.hpp).
std::vector<Cell> in_turns_cells(const std::vector<Cell>& cells);

/// Returns one line per cell: the ratios with their intervals.
std::string in_turns_csv(const std::vector<Cell>& cells);

/// Returns the same as text for a terminal, with the largest ratios.
std::string in_turns_text(const std::vector<Cell>& cells);

}  // namespace pelage
