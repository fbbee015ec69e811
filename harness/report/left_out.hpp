// Lists the cases and inputs that the tables of a report leave out. Every case is either in a table with its
// time, or in this list with the reason.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "harness/journal/all_results.hpp"
#include "harness/report/sections.hpp"

namespace pelage {

/// Returns one entry for each run or shard in which cases have no row (run_states()). An entry states only
/// the number of these cases, because rows do not contain the names of other cases. `rows` were read from
/// `journals`.
std::vector<LeftOut> missing_cases(const std::vector<std::filesystem::path>& journals,
                                   const std::vector<FoundRow>& rows);

/// Returns one entry for each cell without a time, and for each cell without a ratio to the OpenGL baseline
/// if other cells of the experiment have this ratio. Adds one entry for each row whose event times were left
/// out because they are implausible.
std::vector<LeftOut> without_numbers(const std::vector<Cell>& cells, const std::vector<FoundRow>& rows);

/// Returns the section "Left out" with this list. Its files are named left-out. The list must not be empty.
Section left_out_section(const std::vector<LeftOut>& list);

}  // namespace pelage
