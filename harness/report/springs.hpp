// The table of a report that compares our mass-spring solvers with baselines (serial C++ and Eigen).
#pragma once
#include <string>
#include <vector>

#include "harness/record/results_folder.hpp"
#include "harness/table/table.hpp"

namespace pelage {

/// The comparison of one of our solvers with one baseline (member `rival`), for one model and one mass-spring
/// topology. For each round, the baseline's wall time is divided by our solver's wall time; `ratio` is the
/// median of these quotients, and `low` and `high` are the limits of its 95% interval. Our solver's CPU time
/// per core is its CPU time divided by the number of cores. `processor_ratio` is the baseline's CPU time
/// divided by our solver's CPU time per core. `processor_ratio` is 0 if the row does not contain this ratio.
/// Other processes on the machine lengthen wall times but hardly change CPU times.
struct SolverLine {
  std::string model, topology, solver, substeps, device, rival;
  double ours_ms = 0, rival_ms = 0, ratio = 0, low = 0, high = 0, processor_ratio = 0;
};
/// Returns one line per baseline for every row that has the status ok and no overrides (settings changed on
/// the command line). The lines are sorted by device, model, topology, solver, substeps and baseline.
std::vector<SolverLine> solver_lines(const std::vector<FoundRow>& rows);

std::string csv_of(const std::vector<SolverLine>& lines);
/// Returns the lines as a table for readers, with rounded numbers. csv_of() returns them with more digits.
Table table_of(const std::vector<SolverLine>& lines);

}  // namespace pelage
