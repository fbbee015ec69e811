// Lists the cases and the parts of journals that the other tables of a report leave out. Every case is either
// in a table with its time, or in this list with the reason.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "harness/record/all_results.hpp"
#include "harness/report/sections.hpp"

namespace pelage {

/// Returns one entry for each run, or shard (part of a run), in which some cases have no row. An entry states
/// only the number of these cases, because a row does not contain the names of the other cases of its run.
/// `rows` were read from `journals`.
std::vector<LeftOut> missing_cases(const std::vector<std::filesystem::path>& journals,
                                   const std::vector<FoundRow>& rows);

/// Returns one entry for each cell without a time. If some cells of an experiment have a ratio to the OpenGL
/// baseline, also returns one entry for each cell of this experiment that has a time but no such ratio. Adds
/// one entry for each row whose event times were left out because they are implausible.
std::vector<LeftOut> without_numbers(const std::vector<Cell>& cells, const std::vector<FoundRow>& rows);

/// Returns the section "Left out" with this list. Its files are named left-out. The list must not be empty.
Section left_out_section(const std::vector<LeftOut>& list);

}  // namespace pelage
