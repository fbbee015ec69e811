// The cases that decide a claim, with the rows that measured them.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "harness/claims/claim.hpp"
#include "harness/journal/results_folder.hpp"

namespace pelage::claims {

/// One case on one device. If the claim has `phases`, a case gives one cell per phase.
struct Cell {
  std::string name;                         ///< name of the case, with the phase if the claim has phases
  std::map<std::string, std::string> axes;  ///< with "variant", and with "experiment" if there are several
  std::string phase;                        ///< the phase of the times: "frame", or one of `phases`
  /// One row per separate process. The rows are those passed to cells_of and must outlive the cell.
  std::vector<const Row*> processes;
};

struct Cells {
  std::vector<Cell> cells;
  /// The cases that the claim selects and that have a row without a usable quantity, each with the reason.
  std::vector<std::string> left_out;
  /// Number of rows that were timed on a loaded machine (harness/measure/cpu_use.hpp).
  std::size_t contended = 0;
};

/// Returns the cells of the claim in the order of the rows. `rows` are the rows of one device and host. All
/// rows of a case must have the same identity (input_sets()).
Cells cells_of(const Claim& claim, const std::vector<const Row*>& rows);

/// Returns the times of a phase in ms: wall times, or event times if there are no wall times.
const std::vector<double>& times_of(const Row& row, const std::string& phase);

}  // namespace pelage::claims
