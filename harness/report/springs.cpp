#include "harness/report/springs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "harness/measure/provenance.hpp"
#include "harness/measure/statistics.hpp"
#include "harness/table/render.hpp"

namespace pelage {
namespace {

constexpr std::string_view ratio_mark = "_ratio", processor_mark = "_processor_ratio";

std::string of(const std::map<std::string, std::string>& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? std::string() : found->second;
}

}  // namespace

std::vector<SolverLine> solver_lines(const std::vector<FoundRow>& rows) {
  std::vector<SolverLine> lines;
  for (const auto& [row, journal, copies] : rows) {
    if (row.experiment != "topology-solvers" || row.status != Status::ok || !row.overrides.empty()) continue;
    for (const auto& [name, metric] : row.metrics) {
      if (!name.ends_with(ratio_mark) || name.ends_with(processor_mark)) continue;
      SolverLine line{of(row.axes, "model"),
                      of(row.axes, "dynamics.topology"),
                      row.variant,
                      of(row.axes, "dynamics.substeps"),
                      row.device,
                      name.substr(0, name.size() - ratio_mark.size())};
      line.ratio = metric.value;
      line.low = metric.low.value_or(metric.value), line.high = metric.high.value_or(metric.value);
      line.ours_ms = median(frame_ms(row));
      if (const auto theirs = row.samples.find(line.rival); theirs != row.samples.end())
        line.rival_ms = median(theirs->second.wall_ms);
      if (const auto shared = row.metrics.find(line.rival + std::string(processor_mark));
          shared != row.metrics.end())
        line.processor_ratio = shared->second.value;
      lines.push_back(std::move(line));
    }
  }
  std::stable_sort(lines.begin(), lines.end(), [](const SolverLine& a, const SolverLine& b) {
    return std::tie(a.device, a.model, a.topology, a.solver, a.substeps, a.rival) <
           std::tie(b.device, b.model, b.topology, b.solver, b.substeps, b.rival);
  });
  return lines;
}

std::string csv_of(const std::vector<SolverLine>& lines) {
  std::string text =
      csv_line({"device", "model", "topology", "solver", "substeps", "median_ms", "rival", "rival_median_ms",
                "ratio", "ratio_low", "ratio_high", "ratio_by_processor_time"});
  const auto number = [](double value) { return value > 0 ? fmt::format("{:.6g}", value) : std::string(); };
  for (const SolverLine& l : lines)
    text += csv_line({l.device, l.model, l.topology, l.solver, l.substeps, number(l.ours_ms), l.rival,
                      number(l.rival_ms), number(l.ratio), number(l.low), number(l.high),
                      number(l.processor_ratio)});
  return text;
}

Table table_of(const std::vector<SolverLine>& lines) {
  Table table;
  table.title = "Mass-spring solvers against serial C++ and Eigen";
  table.subtitle = "topology-solvers";
  table.stem = "topology-solvers-ratios";
  table.columns = {{"device", "device"},     {"model", "model"},
                   {"topology", "topology"}, {"solver", "solver"},
                   {"substeps", "steps"},    {"median_ms", "ours, ms"},
                   {"rival", "baseline"},    {"rival_median_ms", "baseline, ms"},
                   {"ratio", "ratio"},       {"ratio_by_processor_time", "ratio by CPU time"}};
  table.layout.rows = {"device", "model", "topology", "solver", "substeps", "rival"};
  table.layout.values = {"median_ms", "rival_median_ms", "ratio", "ratio_by_processor_time"};
  const auto number = [](double value) {
    return number_value(value > 0 ? std::optional(value) : std::nullopt);
  };
  for (const SolverLine& l : lines) {
    Value ratio = number(l.ratio);
    if (l.ratio > 0) ratio.shown += fmt::format(" [{}, {}]", three_digits(l.low), three_digits(l.high));
    table.lines.push_back({text_value(l.device), text_value(l.model), text_value(l.topology),
                           text_value(l.solver), text_value(l.substeps), number(l.ours_ms),
                           text_value(l.rival), number(l.rival_ms), std::move(ratio),
                           number(l.processor_ratio)});
  }
  table.remarks = {
      "Our solver and each baseline take turns to compute the same time steps from the same state. The ratio "
      "is the baseline's time divided by our time: the median over the rounds, with its 95% interval. The "
      "ratio by CPU time is the baseline's CPU time divided by our CPU time per core, which is our CPU "
      "time divided by the number of cores. serial-o3 is C++ compiled with -O3. serial-fast is C++ compiled "
      "with -O3 -march=native -ffast-math. The serial baselines use floats unless the name contains double. "
      "eigen-...-1 and eigen-...-2 use Eigen with one and two threads, compiled with -O3 -march=native."};
  return table;
}

}  // namespace pelage
