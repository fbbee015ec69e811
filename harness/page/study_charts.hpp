// Charts of the experiments that have their own plot programs: the mass-spring studies (plots/springs.py) and
// the experiment scaling (plots/scaling.py).
#pragma once
#include <vector>

#include "harness/page/chart.hpp"
#include "harness/report/cells.hpp"

namespace pelage {

/// Returns one chart for each mass-spring study and device of the cells. Cells that are not ok, and cells
/// that the user changed, are ignored.
std::vector<Chart> spring_charts(const std::vector<Cell>& cells);

/// Returns the chart of the frame time against layers, pixels and triangles; no panels if there are too few
/// cells. `cells` are those of scaling_cells().
Chart scaling_chart(const std::vector<Cell>& cells);

}  // namespace pelage
