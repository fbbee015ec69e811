// Tables as comma-separated values (RFC 4180, but lines end with a line feed only).
#pragma once
#include <string>
#include <vector>

#include "harness/journal/results_folder.hpp"

namespace pelage {

/// Returns one line, including its line feed. Fields that contain a comma, a quote or a line break are
/// quoted.
std::string csv_line(const std::vector<std::string>& fields);

/// Returns CSV with one line per row of results, phase and clock ("wall", "event" or "cpu"). A line contains
/// the case, the number of samples, and their median and its 95% interval in ms. A row that is not ok has one
/// line without times. Each axis has a column of its name. Each metric has a column "metric.NAME".
std::string csv_by_phase(const std::vector<FoundRow>& rows);

/// Returns CSV with one line per sample. In place of the number, the median and the interval of the samples,
/// a line contains the index and the time in ms of one sample. All other columns are those of csv_by_phase().
/// A row that is not ok has no line.
std::string csv_by_sample(const std::vector<FoundRow>& rows);

}  // namespace pelage
