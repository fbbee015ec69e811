// Lists what the other tables of a report leave out: every case is either in a table with its time, or here
// with the reason.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "harness/report/sections.hpp"

namespace pelage {

/// Returns one entry for each run or shard in which some cases have no row. It states only their number,
/// because the rows do not contain the names of the other cases of their run. `rows` were read from
/// `journals`.
std::vector<LeftOut> missing_cases(const std::vector<std::filesystem::path>& journals,
                                   const std::vector<FoundRow>& rows);

/// Returns one entry for each cell without a time, for each cell without a ratio to the OpenGL baseline if
/// others of its experiment and variant have one, and for each row whose implausible event times were left
/// out.
std::vector<LeftOut> without_numbers(const std::vector<Cell>& cells, const std::vector<FoundRow>& rows);

/// Returns the section "Left out" with this list, which must not be empty.
Section left_out_section(const std::vector<LeftOut>& list);

}  // namespace pelage
