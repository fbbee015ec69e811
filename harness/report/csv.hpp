// Tables as comma-separated values (RFC 4180, with a single line feed).
#pragma once
#include <string>
#include <vector>

#include "harness/journal/results_folder.hpp"

namespace pelage {

/// Returns one line with its line feed; quotes fields that contain a comma, a quote or a line break.
std::string csv_line(const std::vector<std::string>& fields);

/// Returns tidy long form, one line per row of results, phase and clock ("wall", "event"): the case, the
/// number of samples, their median and its 95% interval, ms. A row that is not ok has one line without times.
/// Each axis is a column with its own name; each metric is a column "metric.NAME".
std::string csv_by_phase(const std::vector<FoundRow>& rows);

/// Returns the same with one line per sample.
std::string csv_by_sample(const std::vector<FoundRow>& rows);

}  // namespace pelage
