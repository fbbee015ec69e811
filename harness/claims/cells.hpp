// Selects the cases that decide a claim, and the rows of results of these cases.
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
  /// Axis -> value, with "variant", and with "experiment" if the claim has several experiments.
  std::map<std::string, std::string> axes;
  std::string phase;  ///< phase whose times count as frame times: "frame", or one of `phases`
  /// The rows of the case, one per process. They belong to the caller of cells_of() and must outlive the
  /// cell.
  std::vector<const Row*> processes;
};

struct Cells {
  std::vector<Cell> cells;
  /// Names of the selected cases that are not used, each with the reason in round brackets: a row of the case
  /// lacks the values from which the claim's quantity is computed.
  std::vector<std::string> left_out;
  /// Number of rows with a load_warning() (harness/measure/cpu_use.hpp).
  std::size_t contended = 0;
};

/// Returns the cells of the claim in the order of the rows, which must be from one device and host. All rows
/// of a case must have been measured with the same inputs (input_sets()).
Cells cells_of(const Claim& claim, const std::vector<const Row*>& rows);

}  // namespace pelage::claims
