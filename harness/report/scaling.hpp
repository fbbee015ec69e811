// What the experiment "scaling" says: what doubling the layers costs, how much memory the cases take, and the
// table that plots/scaling.py fits its model to.
#pragma once
#include <string>
#include <vector>

#include "harness/report/cells.hpp"

namespace pelage {

/// Cells of that experiment as shipped that have a time, a triangle count, layers and a size.
std::vector<Cell> scaling_cells(const std::vector<Cell>& cells);

/// One line per cell, for programs and for plots/scaling.py.
std::string scaling_csv(const std::vector<Cell>& cells);

/// Twice and four times the layers against the same case with fewer, and the most memory; for a terminal.
std::string scaling_text(const std::vector<Cell>& cells);

/// Cells, of any experiment, that were drawn in turns with half and a quarter of their layers
/// (layers_subject.hpp) and are ok.
std::vector<Cell> in_turns_cells(const std::vector<Cell>& cells);

/// One line per cell: the ratios with their intervals.
std::string in_turns_csv(const std::vector<Cell>& cells);

/// The same for a terminal, and the greatest of each.
std::string in_turns_text(const std::vector<Cell>& cells);

}  // namespace pelage
