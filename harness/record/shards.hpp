// Finds the shards and cases of a run that have no rows, from these fields of the provenance of rows:
// - shard: the shard that measured the row
// - shard_cases, all_cases: the numbers of cases of this shard and of the whole run
// - repeats: the number of processes that measured each case (option --repeat)
// Rows of older versions lack these fields. Their shards follow from the names of the journals.
#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "harness/record/results_folder.hpp"

namespace pelage {

/// A shard, or a whole run, in which measurements have no row, or only rows with the status error. A
/// measurement is one case in one process that --repeat starts.
struct Gap {
  int index = 0, count = 1;  ///< shard `index` of `count`; 0 of 1 for a run without shards
  bool whole_run = false;    ///< true if no shard has a gap, but the run as a whole lacks measurements
  std::size_t done = 0;      ///< number of measurements with a row whose status is not error
  std::size_t failed = 0;    ///< number of measurements that have only rows with the status error
  std::optional<std::size_t> expected = {};  ///< required number of measurements; empty if unknown
};

/// The state of a run: all rows of an experiment with the same overrides and the same number of shards on one
/// device of one host, or of several hosts with equally named devices that each have only some of the shards.
struct RunState {
  std::string experiment;
  std::string where;  ///< stem of the journal, DEVICE@HOST or DEVICE; of several, joined by "+"
  std::map<std::string, std::string> overrides;
  std::set<std::string> done;    ///< cases with a row whose status is not error
  std::set<std::string> failed;  ///< cases that have only rows with the status error
  std::vector<Gap> gaps;
  /// True if the shards did not all use the same division of the cases, because their lists of cases or their
  /// times of earlier runs (--balance) differed. A case may then belong to several shards or to none.
  bool dealt_differently = false;
};

/// Returns the states of all runs in `rows`, which were read from `journals`, sorted by experiment and
/// device. The names of journals also state which shards exist, even if a journal has no rows.
std::vector<RunState> run_states(const std::vector<std::filesystem::path>& journals,
                                 const std::vector<FoundRow>& rows);

/// Returns the gap as text, such as "shard 1/4: 5 of 8 cases, 1 ended with an error" or "shard 2/4: no rows".
std::string text_of(const Gap& gap);

}  // namespace pelage
