// The list of what a report leaves out. Every case of every input is in a table with its time, or in this
// list with the reason.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "harness/journal/all_results.hpp"
#include "harness/report/sections.hpp"

namespace pelage {

/// Returns the cases of a run that have no row: one entry per shard or run with such cases, because rows
/// record only the number of cases (run_states()). `journals` are the journals from which `rows` were read.
std::vector<LeftOut> missing_cases(const std::vector<std::filesystem::path>& journals,
                                   const std::vector<FoundRow>& rows);

/// Returns the cells without a time, and the numbers that cells lack although other cells of their experiment
/// have them: the ratio to the OpenGL baseline, and event times that were not plausible.
std::vector<LeftOut> without_numbers(const std::vector<Cell>& cells, const std::vector<FoundRow>& rows);

/// Returns the list as a section with the file name left-out. The list must not be empty.
Section left_out_section(const std::vector<LeftOut>& list);

}  // namespace pelage
