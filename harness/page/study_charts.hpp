// Charts of the experiments that have their own plot programs: plots/springs.py for the mass-spring studies,
// and plots/scaling.py for the experiment `scaling`.
#pragma once
#include <vector>

#include "harness/page/chart.hpp"
#include "harness/report/cells.hpp"

namespace pelage {

/// Returns one chart for each mass-spring study and device that occurs in `cells`. Ignores cells whose status
/// is not ok, and cells whose settings the user changed.
std::vector<Chart> spring_charts(const std::vector<Cell>& cells);

/// Returns a chart with up to three panels: the frame time against layers, against pixels, and against
/// triangles. A panel is left out if none of its lines has points at two different values of x. `cells` is a
/// result of scaling_cells().
Chart scaling_chart(const std::vector<Cell>& cells);

}  // namespace pelage
