// Text and tables of the experiments that vary the numbers of layers, pixels and triangles: time ratios of
// cases that differ only in their number of layers, and memory. plots/scaling.py fits a model of the frame
// time to the table of scaling_csv().
#pragma once
#include <string>
#include <vector>

#include "harness/report/cells.hpp"

namespace pelage {

/// Returns the cells of all experiments whose file sets report.program = "scaling", without cells that lack a
/// time, a triangle count, a number of layers or a picture size. If some cells were changed on the command
/// line, returns only the largest group of cells with equal changes.
std::vector<Cell> scaling_cells(const std::vector<Cell>& cells);

/// Returns CSV with one line per cell, the input of plots/scaling.py.
std::string scaling_csv(const std::vector<Cell>& cells);

/// Returns text for a terminal: the time ratios, and the largest peak memory of all cases.
std::string scaling_text(const std::vector<Cell>& cells);

/// Returns the cells with status ok that have the metrics frame_over_half and frame_over_quarter
/// (harness/subjects/in_turns.hpp).
std::vector<Cell> in_turns_cells(const std::vector<Cell>& cells);

/// Returns CSV with the two metrics of each cell and their 95% intervals. `cells` is a result of
/// in_turns_cells().
std::string in_turns_csv(const std::vector<Cell>& cells);

/// Returns the ratios of in_turns_csv() as text for a terminal, followed by the largest ratios.
std::string in_turns_text(const std::vector<Cell>& cells);

}  // namespace pelage
