// Separates rows that belong to the same case but measured different inputs.
#pragma once
#include <string>
#include <vector>

#include "harness/record/results_folder.hpp"

namespace pelage {

/// Rows in which every case has only one identity (hashes of everything that determines what a row measured),
/// so that all rows of a case may be combined.
struct InputSet {
  std::vector<FoundRow> rows;
  /// Rows of this set are compared with rows of the same cases in the first set. `differs` contains the names
  /// of the parts in which their identities differ, such as "mesh, scene". If one of two compared rows has no
  /// identity (a row of schema 1), `differs` contains "identity incomplete". Empty for the first set.
  std::string differs;
};

/// Divides the rows into sets. Usually, all rows of a journal are added to the same set. A journal conflicts
/// with a set if they contain the same case with different identities. Each journal is added to the first set
/// without a conflict. Here, two rows belong to the same case if they have the same experiment, case,
/// variant, device, host and overrides. A journal can itself contain two identities of the same case. The
/// function then divides the journal into parts, and adds each part like a journal. Within a set, the rows of
/// a journal keep their order. The result has at least one set.
std::vector<InputSet> input_sets(const std::vector<FoundRow>& rows);

}  // namespace pelage
