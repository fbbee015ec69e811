#include "harness/report/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "harness/measure/cpu_use.hpp"
#include "harness/measure/interruptions.hpp"
#include "harness/measure/statistics.hpp"
#include "harness/report/cells.hpp"
#include "harness/table/render.hpp"

namespace pelage {
namespace {

/// Names of the columns that depend on the rows: every axis and every metric that occurs in any row.
struct Columns {
  std::set<std::string> axes, metrics;
  explicit Columns(const std::vector<FoundRow>& rows) {
    for (const FoundRow& found : rows) {
      for (const auto& [key, value] : found.row.axes)
        if (key != "variant") axes.insert(key);
      for (const auto& [name, metric] : found.row.metrics) metrics.insert(name);
    }
  }
};

std::string contended_text(const Row& row) {
  if (!interruption_warning(row).empty()) return "1";
  if (!row.provenance.contains("other_cpu_share")) return {};
  return load_warning(row).empty() ? "0" : "1";
}

std::vector<std::string> head(const Columns& columns, std::vector<std::string> rest) {
  std::vector<std::string> fields{"experiment", "case", "variant"};
  fields.insert(fields.end(), columns.axes.begin(), columns.axes.end());
  fields.insert(fields.end(), {"overrides", "device", "host", "run_id", "repeat", "preset", "identity",
                               "status", "reason", "contended"});
  fields.insert(fields.end(), rest.begin(), rest.end());
  for (const std::string& name : columns.metrics) fields.push_back("metric." + name);
  return fields;
}

std::vector<std::string> body(const Columns& columns, const Row& row, const std::vector<std::string>& rest) {
  std::vector<std::string> fields{row.experiment, row.case_name, row.variant};
  for (const std::string& key : columns.axes) fields.push_back(value_at(row.axes, key));
  fields.insert(fields.end(),
                {changes_of(row.overrides, ";"), row.device, provenance_text(row, "host"), row.run_id,
                 std::to_string(row.repeat), provenance_text(row, "preset"), hash_of(row.identity),
                 std::string(to_text(row.status)), row.reason, contended_text(row)});
  fields.insert(fields.end(), rest.begin(), rest.end());
  for (const std::string& name : columns.metrics)
    fields.push_back(row.metrics.contains(name) ? fmt::format("{:.10g}", row.metrics.at(name).value) : "");
  return fields;
}

struct TimeList {
  std::string phase, clock;
  const std::vector<double>& times;
};

/// Returns the lists of times in the row that are not empty.
std::vector<TimeList> lists_of(const Row& row) {
  std::vector<TimeList> lists;
  for (const auto& [phase, samples] : row.samples) {
    if (!samples.wall_ms.empty()) lists.push_back({phase, "wall", samples.wall_ms});
    if (!samples.event_ms.empty()) lists.push_back({phase, "event", samples.event_ms});
    if (!samples.cpu_ms.empty()) lists.push_back({phase, "cpu", samples.cpu_ms});
  }
  return lists;
}

}  // namespace

std::string csv_by_phase(const std::vector<FoundRow>& rows) {
  const Columns columns(rows);
  std::string text = csv_line(head(columns, {"phase", "clock", "samples", "median_ms", "low_ms", "high_ms"}));
  for (const FoundRow& found : rows) {
    const Row& row = found.row;
    if (row.status != Status::ok || row.samples.empty()) {
      text += csv_line(body(columns, row, {"frame", "wall", "0", "", "", ""}));
      continue;
    }
    for (const auto& [phase, clock, times] : lists_of(row)) {
      const Interval interval = median_interval(times);
      text +=
          csv_line(body(columns, row,
                        {phase, clock, std::to_string(times.size()), fmt::format("{:.10g}", median(times)),
                         fmt::format("{:.10g}", interval.low), fmt::format("{:.10g}", interval.high)}));
    }
  }
  return text;
}

std::string csv_by_sample(const std::vector<FoundRow>& rows) {
  const Columns columns(rows);
  std::string text = csv_line(head(columns, {"phase", "clock", "sample", "ms"}));
  for (const FoundRow& found : rows) {
    if (found.row.status != Status::ok) continue;
    for (const auto& [phase, clock, times] : lists_of(found.row))
      for (std::size_t i = 0; i < times.size(); ++i)
        text += csv_line(
            body(columns, found.row, {phase, clock, std::to_string(i), fmt::format("{:.10g}", times[i])}));
  }
  return text;
}

namespace {

std::string names_of(const Row& row) {
  return fmt::format("{}|{}|{}|{}|{}|{}|{}", row.experiment, row.case_name, row.variant, row.device,
                     provenance_text(row, "host"), changes_of(row.overrides, "|"), changes_of(row.axes, "|"));
}

/// The identities of cases.
class Identities {
 public:
  void add(const FoundRow& found) { identities_[names_of(found.row)] = found.row.identity; }
  const Identity* of(const FoundRow& found) const {
    const auto place = identities_.find(names_of(found.row));
    return place == identities_.end() ? nullptr : &place->second;
  }
  bool conflict(const FoundRow& found) const { return of(found) && *of(found) != found.row.identity; }

 private:
  std::map<std::string, Identity> identities_;  // result of names_of() -> identity
};

}  // namespace

std::vector<InputSet> input_sets(const std::vector<FoundRow>& rows) {
  struct Part {
    InputSet set;
    Identities identities;
    std::set<std::string> differing;
  };
  std::vector<Part> parts(1);
  for (const std::vector<const FoundRow*>& group : groups_of<Identities>(rows)) {
    auto part = std::ranges::find_if(parts, [&](const Part& p) {
      return std::ranges::none_of(group, [&](auto* found) { return p.identities.conflict(*found); });
    });
    if (part == parts.end()) part = parts.insert(part, Part{});
    for (const FoundRow* found : group) {
      part->set.rows.push_back(*found);
      part->identities.add(*found);
      const Identity* first = parts.front().identities.of(*found);
      if (!first || part == parts.begin()) continue;
      if (found->row.identity.empty() || first->empty())
        part->differing.insert("identity incomplete");
      else
        for (const std::string& name : differing_parts(*first, found->row.identity))
          part->differing.insert(name);
    }
  }
  std::vector<InputSet> sets;
  for (Part& part : parts) {
    part.set.differs = fmt::format("{}", fmt::join(part.differing, ", "));
    sets.push_back(std::move(part.set));
  }
  return sets;
}

}  // namespace pelage
