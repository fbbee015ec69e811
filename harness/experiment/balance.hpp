// Divides the cases of a run among shards (parts of the run that separate processes or machines measure), so
// that all shards take about the same time.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/experiment/experiment.hpp"
#include "harness/record/results_folder.hpp"

namespace pelage {

/// Returns the wall time of the case in seconds. `row` is the recorded result of this case. The wall time is
/// the sum of the times for preparing the scene, for sampling and for the checks. Rows that older versions of
/// pelage wrote lack the sampling time. For these rows the function uses the sum of the row's wall times
/// instead. Returns no value if the status of the row is `error` or `skipped`, because the case did not
/// finish.
std::optional<double> case_seconds(const Row& row);

/// Returns for each case the mean of case_seconds() over all rows of this case in the experiment
/// `experiment`. A case for which no row has a time gets no value.
std::vector<std::optional<double>> earlier_seconds(const std::string& experiment,
                                                   const std::vector<Case>& cases,
                                                   const std::vector<FoundRow>& rows);

/// Returns for each case the index of its shard, from 0 to `count` - 1. The function assigns the cases in the
/// order of decreasing time. Each case goes to the shard with the smallest sum of times so far. If two cases
/// have equal times, the case with the smaller index comes first. If two shards have equal sums, the shard
/// with the smaller index gets the case. For a case without a time the function uses the mean of the known
/// times. If no time is known, case i goes to shard i modulo `count`.
std::vector<int> deal(const std::vector<std::optional<double>>& seconds, int count);

/// Returns a hash of the names of all cases and of their shard indices, as 16 hex digits. All shards of one
/// run must have the same hash. Otherwise a case may belong to several shards or to none.
std::string hash_of_deal(const std::vector<Case>& cases, const std::vector<int>& shards);

}  // namespace pelage
