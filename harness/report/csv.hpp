// Writes rows of results as CSV (comma-separated values, RFC 4180). Lines end with a line feed only.
#pragma once
#include <string>
#include <vector>

#include "harness/record/results_folder.hpp"

namespace pelage {

/// Returns CSV with one line per row of results, phase and clock ("wall", "event" or "cpu"). A line contains
/// the case, the number of samples, and their median and its 95% interval in ms. A row whose status is not
/// "ok" has one line without times. The column `contended` is 1 if other processes used more than
/// most_other_share of the machine's CPU time during the timing, else 0. It is empty if the row does not
/// contain this share. Each axis of the experiments (such as layers) has a column with the axis's name as its
/// heading. Each metric has a column with the heading "metric.NAME".
std::string csv_by_phase(const std::vector<FoundRow>& rows);

/// Returns CSV with one line per sample. A line contains the index of one sample and the time of this sample
/// in ms. It contains neither the number of samples nor their median and its interval. All other columns are
/// those of csv_by_phase(). A row whose status is not "ok" has no line.
std::string csv_by_sample(const std::vector<FoundRow>& rows);

}  // namespace pelage
