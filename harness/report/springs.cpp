// Makes the table of a report that compares our mass-spring solvers with baselines (serial C++ and Eigen).
#include <fmt/format.h>

#include <algorithm>

#include "harness/measure/statistics.hpp"
#include "harness/report/sections.hpp"

namespace pelage {
namespace {

constexpr std::string_view ratio_mark = "_ratio", processor_mark = "_processor_ratio";

Value text_of(const std::map<std::string, std::string>& axes, const std::string& axis) {
  const auto found = axes.find(axis);
  return text_value(found == axes.end() ? "" : found->second);
}

Value positive(double value) {
  return number_value(value > 0 ? std::optional(value) : std::nullopt);
}

/// Returns the line of the baseline `rival`, to which the row has the ratio `ratio`.
std::vector<Value> solver_line(const Row& row, const std::string& rival, const Metric& ratio) {
  const auto theirs = row.samples.find(rival);
  const auto shared = row.metrics.find(rival + std::string(processor_mark));
  const double low = ratio.low.value_or(ratio.value), high = ratio.high.value_or(ratio.value);
  Value shown = positive(ratio.value);
  if (ratio.value > 0) shown.shown += fmt::format(" [{}, {}]", three_digits(low), three_digits(high));
  return {text_value(row.device),
          text_of(row.axes, "model"),
          text_of(row.axes, "dynamics.topology"),
          text_value(row.variant),
          text_of(row.axes, "dynamics.substeps"),
          positive(median(frame_ms(row))),
          text_value(rival),
          positive(theirs == row.samples.end() ? 0 : median(theirs->second.wall_ms)),
          shown,
          positive(low),
          positive(high),
          positive(shared == row.metrics.end() ? 0 : shared->second.value)};
}

}  // namespace

Table solver_table(const std::vector<FoundRow>& rows) {
  Table table;
  table.title = "Mass-spring solvers against serial C++ and Eigen";
  table.subtitle = "topology-solvers";
  table.stem = "topology-solvers-ratios";
  table.columns = {{"device", "device"},     {"model", "model"},
                   {"topology", "topology"}, {"solver", "solver"},
                   {"substeps", "steps"},    {"median_ms", "ours, ms"},
                   {"rival", "baseline"},    {"rival_median_ms", "baseline, ms"},
                   {"ratio", "ratio"},       {"ratio_low", "low"},
                   {"ratio_high", "high"},   {"ratio_by_processor_time", "ratio by CPU time"}};
  table.layout.rows = {"device", "model", "topology", "solver", "substeps", "rival"};
  table.layout.values = {"median_ms", "rival_median_ms", "ratio", "ratio_by_processor_time"};
  for (const auto& [row, journal, copies] : rows) {
    if (row.experiment != "topology-solvers" || row.status != Status::ok || !row.overrides.empty()) continue;
    for (const auto& [name, metric] : row.metrics)
      if (name.ends_with(ratio_mark) && !name.ends_with(processor_mark))
        table.lines.push_back(solver_line(row, name.substr(0, name.size() - ratio_mark.size()), metric));
  }
  const auto key = [&](const std::vector<Value>& line) {
    std::vector<std::string> texts;
    for (const std::string& name : table.layout.rows)
      texts.push_back(line[std::size_t(column_of(table, name))].data);
    return texts;
  };
  std::stable_sort(table.lines.begin(), table.lines.end(),
                   [&](const auto& a, const auto& b) { return key(a) < key(b); });
  table.remarks = {
      "Our solver and each baseline take turns to compute the same time steps from the same state. The ratio is the baseline's time divided by our time: the median over the rounds, with its 95% interval. The ratio by CPU time is the baseline's CPU time divided by our CPU time per core, which is our CPU time divided by the number of cores. serial-o3 is C++ compiled with -O3. serial-fast is C++ compiled with -O3 -march=native -ffast-math. The serial baselines use floats unless the name contains double. eigen-...-1 and eigen-...-2 use Eigen with one and two threads, compiled with -O3 -march=native."};
  return table;
}

}  // namespace pelage
