// Tables as comma-separated values (RFC 4180, with a single line feed).
#pragma once
#include <string>
#include <vector>

#include "harness/journal/results_folder.hpp"

namespace pelage {

/// One line, its line feed included; a field with a comma, a quote or a line break is quoted.
std::string csv_line(const std::vector<std::string>& fields);

/// Tidy long form, one line per row of results, phase and clock ("wall", "event"): what it was, how many
/// samples, their median and its 95% interval, ms. A row that is not ok has one line without times. Axes are
/// columns of their own names, metrics of "metric.NAME".
std::string csv_by_phase(const std::vector<FoundRow>& rows);

/// The same with one line per sample.
std::string csv_by_sample(const std::vector<FoundRow>& rows);

}  // namespace pelage
