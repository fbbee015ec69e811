#include "harness/record/shards.hpp"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

namespace pelage {
namespace {

namespace fs = std::filesystem;

std::size_t count(const Row& row, const char* key) {
  const auto found = row.provenance.find(key);
  if (found == row.provenance.end() || !found->is_number_integer()) return 0;
  return std::size_t(std::max(found->get<std::int64_t>(), std::int64_t(0)));
}

/// What the rows of one shard contain, and what it should contain.
struct ShardRows {
  /// Maps (case, repeat) to true if a row without an error exists.
  std::map<std::pair<std::string, int>, bool> measured;
  /// The largest values that the rows of the shard record; 0 cases if no row records them.
  std::size_t cases = 0, all_cases = 0, repeats = 1;
  std::set<std::string> deals;

  void add(const Row& row) {
    measured[{row.case_name, row.repeat}] |= row.status != Status::error;
    cases = std::max(cases, count(row, "shard_cases"));
    all_cases = std::max(all_cases, count(row, "all_cases"));
    repeats = std::max(repeats, count(row, "repeats"));
    if (const std::string deal = provenance_text(row, "shard_deal"); !deal.empty()) deals.insert(deal);
  }
  void add(const ShardRows& other) {
    for (const auto& [measurement, good] : other.measured) measured[measurement] |= good;
    cases = std::max(cases, other.cases);
    all_cases = std::max(all_cases, other.all_cases);
    repeats = std::max(repeats, other.repeats);
    deals.insert(other.deals.begin(), other.deals.end());
  }
  std::size_t done() const {
    return std::size_t(std::ranges::count_if(measured, [](const auto& m) { return m.second; }));
  }
};

using Shards = std::map<int, ShardRows>;  // shard index -> data of the shard

/// A run on one or more hosts: experiment, device name, number of shards, overrides.
using Family = std::tuple<std::string, std::string, int, std::map<std::string, std::string>>;

std::string device_of(const std::string& stem) {
  return stem.substr(0, stem.find('@'));
}

/// Returns the index of the row's shard, and the number of shards.
std::pair<int, int> shard_of(const FoundRow& found) {
  static const RE2 recorded("([0-9]{1,6})/([0-9]{1,6})");
  JournalName shard;
  if (!RE2::FullMatch(provenance_text(found.row, "shard"), recorded, &shard.index, &shard.count) ||
      shard.index >= shard.count)
    shard = journal_name(found.journal);
  return {shard.index, shard.count};
}

/// A run with more shards than cases has shards without a case. Therefore a shard without a row is no gap if
/// the other shards together have all cases of the run. `run` is the sum of all shards.
std::vector<Gap> gaps_of(const Shards& shards, const ShardRows& run, int count) {
  std::vector<Gap> gaps;
  std::size_t known = 0;
  for (const auto& [index, shard] : shards) known += shard.cases;
  for (int index = 0; index < count; ++index) {
    const auto found = shards.find(index);
    if (found == shards.end() || found->second.measured.empty()) {
      if (run.all_cases == 0 || known < run.all_cases) gaps.push_back({index, count});
      continue;
    }
    const ShardRows& shard = found->second;
    Gap gap{index, count, false, shard.done(), shard.measured.size() - shard.done(), std::nullopt};
    if (shard.cases > 0) gap.expected = shard.cases * shard.repeats;
    if (gap.failed > 0 || gap.done < gap.expected) gaps.push_back(gap);
  }
  const std::size_t done = run.done(), expected = run.all_cases * run.repeats;
  if (gaps.empty() && done < expected)
    gaps.push_back({.count = count, .whole_run = true, .done = done, .expected = expected});
  return gaps;
}

RunState state_of(const Family& family, const std::vector<std::string>& stems, const Shards& shards) {
  RunState state;
  ShardRows run;
  for (const auto& [index, shard] : shards) run.add(shard);
  state.experiment = std::get<0>(family);
  state.where = stems.front();
  for (const std::string& stem : std::span(stems).subspan(1))
    state.where += "+" + stem.substr(stem.find('@') + 1);
  state.overrides = std::get<3>(family);
  for (const auto& [measurement, good] : run.measured)
    (good ? state.done : state.failed).insert(measurement.first);
  for (const std::string& name : state.done) state.failed.erase(name);
  state.gaps = gaps_of(shards, run, std::get<2>(family));
  state.dealt_differently = run.deals.size() > 1;
  return state;
}

}  // namespace

std::vector<RunState> run_states(const std::vector<fs::path>& journals, const std::vector<FoundRow>& rows) {
  // families[family][stem] holds the shards whose journals are named stem.jsonl or stem.i-of-n.jsonl
  std::map<Family, std::map<std::string, Shards>> families;
  for (const FoundRow& found : rows) {
    const auto [index, count] = shard_of(found);
    const std::string stem = journal_name(found.journal).stem;
    families[{found.row.experiment, device_of(stem), count, found.row.overrides}][stem][index].add(found.row);
  }
  for (const fs::path& journal : journals) {
    const JournalName name = journal_name(journal);
    for (auto& [family, stems] : families)
      if (std::get<0>(family) == journal.parent_path().filename() &&
          std::get<1>(family) == device_of(name.stem) && std::get<2>(family) == name.count && name.count > 1)
        stems[name.stem][name.index];
  }
  std::vector<RunState> states;
  for (const auto& [family, stems] : families) {
    Shards joined;
    std::vector<std::string> hosts;
    for (const auto& [stem, shards] : stems) {
      if (int(shards.size()) == std::get<2>(family)) {
        states.push_back(state_of(family, {stem}, shards));
        continue;
      }
      hosts.push_back(stem);
      for (const auto& [index, shard] : shards) joined[index].add(shard);
    }
    if (!hosts.empty()) states.push_back(state_of(family, hosts, joined));
  }
  return states;
}

std::string text_of(const Gap& gap) {
  std::string text = gap.whole_run   ? "whole run: "
                     : gap.count > 1 ? fmt::format("shard {}/{}: ", gap.index, gap.count)
                                     : "run: ";
  if (gap.done + gap.failed == 0) return text + "no rows";
  if (gap.expected)
    text += fmt::format("{} of {} cases", gap.done, *gap.expected);
  else
    text += fmt::format("{} cases", gap.done);
  if (gap.failed > 0) text += fmt::format(", {} ended with an error", gap.failed);
  return text;
}

}  // namespace pelage
