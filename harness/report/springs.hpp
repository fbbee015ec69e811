// The mass-spring experiments in a report: their charts, and the table of solvers against rivals.
#pragma once
#include <string>
#include <vector>

#include "harness/journal/results_folder.hpp"

namespace pelage {

/// Rows of one experiment that a chart of plots/springs.py is drawn from.
struct SpringsChart {
  std::string title, stem;
  std::vector<FoundRow> rows;
};
/// One per experiment and device that has a chart and at least one row that is ok.
std::vector<SpringsChart> springs_charts(const std::vector<FoundRow>& rows);

/// A solver on a topology over a model, and one rival. Ratios are the rival's time by ours: by the wall
/// clock, round by round, with the 95% interval; and by processor time, ours shared by all cores, which other
/// work on the machine does not move (0: not known).
struct SolverLine {
  std::string model, topology, solver, substeps, device, rival;
  double ours_ms = 0, rival_ms = 0, ratio = 0, low = 0, high = 0, processor_ratio = 0;
};
/// Every rival of every row that is ok and the experiment's own, sorted by model, topology, solver, substeps.
std::vector<SolverLine> solver_lines(const std::vector<FoundRow>& rows);

std::string csv_of(const std::vector<SolverLine>& lines);
std::string html_of(const std::vector<SolverLine>& lines);

}  // namespace pelage
