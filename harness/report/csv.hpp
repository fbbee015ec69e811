// Writes rows of results as CSV (comma-separated values, RFC 4180). Lines end with a line feed only.
#pragma once
#include <string>
#include <vector>

#include "harness/record/results_folder.hpp"

namespace pelage {

/// Returns CSV with one line per row of results, phase and clock ("wall", "event" or "cpu"): the case, the
/// number of samples, and their median and its 95% interval in ms. A row whose status is not "ok" has one
/// line without times. The column `contended` is 1 if the row has a load_warning(), else 0, and empty if the
/// row does not contain the CPU time of other processes. Each axis and each metric (metric.NAME) of the rows
/// has a column.
std::string csv_by_phase(const std::vector<FoundRow>& rows);

/// Returns CSV with one line per sample, with its index and time in ms in place of the statistics of
/// csv_by_phase(). A row whose status is not "ok" has no line.
std::string csv_by_sample(const std::vector<FoundRow>& rows);

}  // namespace pelage
