// Separates rows that measured different inputs under the same names.
#pragma once
#include <string>
#include <vector>

#include "harness/journal/results_folder.hpp"

namespace pelage {

/// Rows in which every case has only one identity, so that all rows of a case may be combined.
struct InputSet {
  std::vector<FoundRow> rows;
  /// The parts of the identity in which the rows differ from the rows of the first set with the same names,
  /// such as "mesh, scene"; "identity incomplete" if rows of schema 1 are among them. "" for the first set.
  std::string differs;
};

/// Divides the rows into sets. The rows of one journal stay together, and each journal is added to the first
/// set that contains none of its cases (experiment, case, variant, device, host and overrides) with another
/// identity. If a journal itself contains a case with two identities, it is divided first. The order of the
/// rows is kept. There is at least one set.
std::vector<InputSet> input_sets(const std::vector<FoundRow>& rows);

}  // namespace pelage
