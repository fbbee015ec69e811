// Divides the cases of a run among shards, so that all shards take about the same time.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/experiment/experiment.hpp"
#include "harness/record/results_folder.hpp"

namespace pelage {

/// Returns the wall time of the case in seconds: preparation, sampling and checks. For rows of older
/// versions, which lack the sampling time, the sum of the wall times counts instead. Returns no value if the
/// case did not finish (status `error` or `skipped`).
std::optional<double> case_seconds(const Row& row);

/// Returns for each case the mean of case_seconds() over its rows in the experiment, if there are any.
std::vector<std::optional<double>> earlier_seconds(const std::string& experiment,
                                                   const std::vector<Case>& cases,
                                                   const std::vector<FoundRow>& rows);

/// Returns for each case the index of its shard, from 0 to `count` - 1: in the order of decreasing time, each
/// case goes to the shard with the smallest sum of times so far, ties to the smaller index. A case without a
/// time counts as the mean of the known times. If no time is known, case i goes to shard i modulo `count`.
std::vector<int> deal(const std::vector<std::optional<double>>& seconds, int count);

/// Returns a hash of the names of all cases and of their shard indices. All shards of one run must have the
/// same hash. Otherwise a case may belong to several shards or to none.
std::string hash_of_deal(const std::vector<Case>& cases, const std::vector<int>& shards);

}  // namespace pelage
