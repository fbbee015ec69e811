// The division of the cases of a run among shards.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/experiment/experiment.hpp"
#include "harness/journal/results_folder.hpp"

namespace pelage {

/// Returns the wall time in seconds that the row's case took: preparation of the scene, sampling and checks.
/// Rows of older versions do not record the time of the sampling; for them it is the sum of the frame times
/// and of the first frame. Empty for a row with the status error or skipped, because its case did not run to
/// its end.
std::optional<double> case_seconds(const Row& row);

/// Returns for each case the mean of case_seconds() over the rows of this experiment and case; empty for a
/// case without such a row.
std::vector<std::optional<double>> earlier_seconds(const std::string& experiment,
                                                   const std::vector<Case>& cases,
                                                   const std::vector<FoundRow>& rows);

/// Returns for each case the index of its shard, from 0 to `count` - 1. The cases are taken in the order of
/// decreasing time; each goes to the shard with the smallest sum of times so far. Between equal times the
/// earlier case comes first, and between equal sums the shard with the smaller index. A case without a time
/// counts with the mean of the others. If no case has a time, every count-th case belongs to one shard.
std::vector<int> deal(const std::vector<std::optional<double>>& seconds, int count);

/// Returns 16 hex digits, a hash of the names of the cases and of their shards. Shards of one run must have
/// equal hashes; otherwise a case may belong to several shards or to none.
std::string hash_of_deal(const std::vector<Case>& cases, const std::vector<int>& shards);

}  // namespace pelage
