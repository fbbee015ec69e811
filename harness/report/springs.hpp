// Mass-spring experiments in a report: the charts, and the table of solvers against baselines.
#pragma once
#include <string>
#include <vector>

#include "harness/journal/results_folder.hpp"

namespace pelage {

/// Rows of one experiment for a chart of plots/springs.py.
struct SpringsChart {
  std::string title, stem;
  std::vector<FoundRow> rows;
};
/// Returns one chart per experiment and device with at least one ok row, for experiments that have a chart.
std::vector<SpringsChart> springs_charts(const std::vector<FoundRow>& rows);

/// A solver on a topology over a model, and one baseline (member `rival`). Ratios are the baseline's time
/// over ours: by the wall clock, round by round, with the 95% interval; and by processor time, with ours
/// divided by the number of cores, which other work on the machine does not change (0: not known).
struct SolverLine {
  std::string model, topology, solver, substeps, device, rival;
  double ours_ms = 0, rival_ms = 0, ratio = 0, low = 0, high = 0, processor_ratio = 0;
};
/// Returns a line for every baseline of every ok row without overrides, sorted by model, topology, solver,
/// substeps.
std::vector<SolverLine> solver_lines(const std::vector<FoundRow>& rows);

std::string csv_of(const std::vector<SolverLine>& lines);
std::string html_of(const std::vector<SolverLine>& lines);

}  // namespace pelage
