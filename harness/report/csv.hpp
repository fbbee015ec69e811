// Writes rows of results as CSV (comma-separated values, RFC 4180; lines end with a line feed only), and
// separates rows that belong to the same case but measured different inputs.
#pragma once
#include <string>
#include <vector>

#include "harness/record/results_folder.hpp"

namespace pelage {

/// Returns CSV with one line per row of results, phase and clock ("wall", "event" or "cpu"): the case, the
/// number of samples, and their median and its 95% interval in ms. A row whose status is not "ok" has one
/// line without times. The column `contended` is 1 if the row has a load_warning() or an
/// interruption_warning(), else 0, and empty if the row does not contain the CPU time of other processes.
/// Each axis and each metric (metric.NAME) of the rows has a column.
std::string csv_by_phase(const std::vector<FoundRow>& rows);

/// Returns CSV with one line per sample, with its index and time in ms in place of the statistics of
/// csv_by_phase(). A row whose status is not "ok" has no line.
std::string csv_by_sample(const std::vector<FoundRow>& rows);

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
