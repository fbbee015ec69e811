// Separates rows that belong to the same case but measured different inputs.
#pragma once
#include <string>
#include <vector>

#include "harness/record/results_folder.hpp"

namespace pelage {

/// Rows in which every case has only one identity, so that all rows of a case may be combined.
struct InputSet {
  std::vector<FoundRow> rows;
  /// Names of the parts in which the identities of this set's rows differ from those of the same cases in the
  /// first set, such as "mesh, scene"; "identity incomplete" if a row has no identity (schema 1). Empty for
  /// the first set.
  std::string differs;
};

/// Divides the rows into sets. Each journal is added to the first set without a conflict: the same case
/// (experiment, case, variant, device, host and overrides) with another identity. A journal that itself
/// contains two identities of a case is divided into parts, which are added like journals. Within a set, the
/// rows of a journal keep their order. The result has at least one set.
std::vector<InputSet> input_sets(const std::vector<FoundRow>& rows);

}  // namespace pelage
