// Separates rows that belong to the same case but measured different inputs.
#pragma once
#include <string>
#include <vector>

#include "harness/journal/results_folder.hpp"

namespace pelage {

/// Rows in which every case has only one identity, so that all rows of a case may be combined.
struct InputSet {
  std::vector<FoundRow> rows;
  /// The parts of the identity, such as "mesh, scene", in which rows of this set differ from rows of the same
  /// case in the first set. If one of two such rows has no identity (a row of schema 1), the text contains
  /// "identity incomplete". Empty for the first set.
  std::string differs;
};

/// Divides the rows into sets. The rows of one journal stay together. Each journal is added to the first set
/// in which no case of the journal has another identity. Here, two rows belong to the same case if they have
/// the same experiment, case, variant, device, host and overrides. If a journal contains two identities of
/// the same case, the journal is divided first. Within a set, the rows of a journal keep their order. The
/// result has at least one set.
std::vector<InputSet> input_sets(const std::vector<FoundRow>& rows);

}  // namespace pelage
