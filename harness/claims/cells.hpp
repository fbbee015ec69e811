// Selects the cases that decide a claim, and the rows of results of these cases. The cases of an experiment
// differ in the values of parameters, which are called axes. A row contains the measurements of one case in
// one process.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "harness/claims/claim.hpp"
#include "harness/record/results_folder.hpp"

namespace pelage::claims {

/// One case of the claim, measured on one device. If Claim::phases is not empty, each of these phases is a
/// separate cell.
struct Cell {
  std::string name;  ///< name of the case, with the phase if the claim has phases
  /// Axis -> value. "variant" is always an axis; "experiment" is an axis if the claim has several
  /// experiments.
  std::map<std::string, std::string> axes;
  std::string phase;  ///< phase whose times count as frame times: "frame", or one of `phases`
  /// The rows of the case, one per process that measured it. They belong to the caller of cells_of() and must
  /// outlive the cell.
  std::vector<const Row*> processes;
};

struct Cells {
  std::vector<Cell> cells;
  /// Names of the selected cases that are not used. The reason follows each name in round brackets. A case
  /// is not used if any of its rows lacks the values from which the claim's quantity is computed.
  std::vector<std::string> left_out;
  /// Number of rows that were timed while other processes used more than most_other_share of the CPU time
  /// (harness/measure/cpu_use.hpp).
  std::size_t contended = 0;
};

/// Returns the cells of the claim in the order of the rows. All `rows` must be from one device and host. All
/// rows of a case must have been measured with the same inputs (input_sets()).
Cells cells_of(const Claim& claim, const std::vector<const Row*>& rows);

}  // namespace pelage::claims
