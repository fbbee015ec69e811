#include "harness/experiment/balance.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

#include "harness/hash.hpp"

namespace pelage {
namespace {

std::optional<double> seconds(const Row& row, const char* key) {
  const std::optional<double> value = provenance_number(row, key);
  return value && *value >= 0 ? value : std::nullopt;
}

double sampled_seconds(const Row& row) {
  double milliseconds = row.first_launch_ms;
  for (const auto& [phase, times] : row.samples)
    milliseconds = std::accumulate(times.wall_ms.begin(), times.wall_ms.end(), milliseconds);
  return milliseconds / 1000;
}

}  // namespace

std::optional<double> case_seconds(const Row& row) {
  if (row.status == Status::error || row.status == Status::skipped) return {};
  return seconds(row, "prepare_s").value_or(0) + seconds(row, "check_s").value_or(0) +
         seconds(row, "sampling_s").value_or(sampled_seconds(row));
}

std::vector<std::optional<double>> earlier_seconds(const std::string& experiment,
                                                   const std::vector<Case>& cases,
                                                   const std::vector<FoundRow>& rows) {
  std::map<std::string, std::pair<double, int>> sums;  // case name -> sum of the times in s, number of rows
  for (const FoundRow& found : rows) {
    if (found.row.experiment != experiment) continue;
    if (const std::optional<double> time = case_seconds(found.row)) {
      auto& [sum, count] = sums[found.row.case_name];
      sum += *time;
      ++count;
    }
  }
  std::vector<std::optional<double>> result;
  result.reserve(cases.size());
  for (const Case& which : cases) {
    const auto found = sums.find(which.name);
    result.push_back(found == sums.end() ? std::nullopt
                                         : std::optional(found->second.first / found->second.second));
  }
  return result;
}

std::vector<int> deal(const std::vector<std::optional<double>>& seconds, int count) {
  std::vector<int> shards(seconds.size());
  double sum = 0;
  int known = 0;
  for (const std::optional<double>& time : seconds) {
    sum += time.value_or(0);
    known += time.has_value();
  }
  const double mean = known ? sum / known : 1.0;  // equal times are dealt in turn
  const auto time_of = [&](std::size_t i) { return seconds[i].value_or(mean); };
  std::vector<std::size_t> order(seconds.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return time_of(a) > time_of(b); });
  using Load = std::pair<double, int>;  // sum of the shard's times in s, index of the shard
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (int shard = 0; shard < count; ++shard) loads.emplace(0.0, shard);
  for (const std::size_t i : order) {
    const auto [load, shard] = loads.top();
    loads.pop();
    shards[i] = shard;
    loads.emplace(load + time_of(i), shard);
  }
  return shards;
}

std::string hash_of_deal(const std::vector<Case>& cases, const std::vector<int>& shards) {
  Hash hash;
  for (std::size_t i = 0; i < cases.size(); ++i) hash.text(cases[i].name).number(std::uint64_t(shards[i]));
  return hash.hex();
}

}  // namespace pelage
