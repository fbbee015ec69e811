// Finds the shards and cases of a run that have no rows. A row records the shard that measured it, the number
// of cases of this shard and of the whole run, and the number of processes (provenance: shard, shard_cases,
// all_cases, repeats). Rows of older versions do not record these numbers; the shards of such rows are known
// only from the names of the journals.
#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "harness/journal/results_folder.hpp"

namespace pelage {

/// Measurements of a shard that have no row, or only rows with the status error. A measurement is a case in
/// one process of --repeat.
struct Gap {
  int index = 0, count = 1;  ///< the shard; 0 of 1 is a run without shards
  bool whole_run = false;    ///< the gap is in the run as a whole, although no shard has a gap
  std::size_t done = 0;      ///< measurements with a row whose status is not error
  std::size_t failed = 0;    ///< measurements that have only rows with the status error
  std::optional<std::size_t> expected = {};  ///< number of measurements; empty if no row records it
};

/// The rows of an experiment with the same overrides and number of shards on one device of one host. Hosts
/// that do not have all shards and have a device of the same name are combined in one RunState.
struct RunState {
  std::string experiment;
  std::string where;  ///< DEVICE@HOST, or "DEVICE@" and several hosts separated by "+"
  std::map<std::string, std::string> overrides;
  std::set<std::string> done;    ///< cases with a row whose status is not error
  std::set<std::string> failed;  ///< cases that have only rows with the status error
  std::vector<Gap> gaps;
  /// Whether the shards come from different divisions of the cases: from different lists of cases, or from
  /// different earlier times (--balance). A case may then belong to several shards or to none.
  bool dealt_differently = false;
};

/// Returns the states of all runs in `rows`, sorted by experiment and device. `journals` are the journals
/// from which `rows` were read. A journal without rows counts as an existing shard.
std::vector<RunState> run_states(const std::vector<std::filesystem::path>& journals,
                                 const std::vector<FoundRow>& rows);

/// Returns the gap as text: "shard 1/4: 5 of 8 cases, 1 ended with an error", "shard 2/4: no rows".
std::string text_of(const Gap& gap);

}  // namespace pelage
