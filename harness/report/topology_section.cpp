// Makes the report section (a table and its plots) of an experiment that compares mass-spring topologies, and
// the table that compares our mass-spring solvers with baselines (serial C++ and Eigen).
#include <fmt/format.h>

#include <algorithm>

#include "harness/measure/statistics.hpp"
#include "harness/report/case_table.hpp"
#include "harness/report/sections.hpp"

namespace pelage {
namespace {

constexpr const char* axis = "dynamics.topology";

/// Returns the topologies of the cells in the order of the key's choices.
std::vector<std::string> topologies_of(const std::vector<Cell>& cells, const Table& table) {
  std::vector<std::string> names;
  for (const std::string& name : table.columns[std::size_t(column_of(table, axis))].order)
    if (std::any_of(cells.begin(), cells.end(), [&](const Cell& c) { return c.axis(axis) == name; }))
      names.push_back(name);
  return names;
}

Table shares_of(const std::vector<Cell>& cells, const std::vector<std::string>& topologies) {
  Table table;
  table.title = "Simulation's share of the frame time";
  table.columns = {{"topology", "topology"},
                   {"by_first", "frame, times " + (topologies.empty() ? std::string() : topologies.front())},
                   {"cases", "cases"},
                   {"share_median", "median share"},
                   {"share_most", "largest share"},
                   {"most_case", "case with the largest share"}};
  table.layout = {{}, {"topology"}, {}, {"by_first", "cases", "share_median", "share_most", "most_case"}};
  const auto percent = [](double share) {
    return Value{fmt::format("{:.6g}", share), fmt::format("{:.2g}%", 100 * share)};
  };
  for (const std::string& topology : topologies) {
    std::vector<double> ratios, shares;
    std::string worst;
    double most = 0;
    for (const Cell& c : cells) {
      if (c.axis(axis) != topology || !timed(c)) continue;
      if (const Cell* first = counterpart(cells, c, axis, topologies.front()))
        ratios.push_back(c.median_ms / first->median_ms);
      const auto simulate = found_in(c.phase_ms, "simulate");
      if (!simulate) continue;
      shares.push_back(*simulate / c.median_ms);
      if (shares.back() >= most) most = shares.back(), worst = name_of(c, axis);
    }
    table.lines.push_back(
        {text_value(topology),
         number_value(ratios.empty() ? std::nullopt : std::optional(geometric_mean(ratios))),
         count_value(double(ratios.size())), shares.empty() ? number_value({}) : percent(median(shares)),
         shares.empty() ? number_value({}) : percent(most), text_value(worst)});
  }
  table.remarks = {
      "Frame: frame time divided by the frame time of the first topology (geometric mean over the cases). Share: time of the simulation divided by the frame time."};
  return table;
}

}  // namespace

std::vector<Section> topology_sections(const std::vector<Cell>& given, const std::string& stem,
                                       const Sources& sources) {
  std::vector<Cell> cells = given;
  sort_cells(cells);
  auto columns = case_columns(cells);
  const std::vector<std::string> topologies = topologies_of(cells, table_of({}, columns));
  columns.push_back({{"ratio", "ratio"}, [&](const Cell& c) {
                       const Cell* first =
                           topologies.empty() ? nullptr : counterpart(cells, c, axis, topologies.front());
                       return number_value(first && timed(c) ? std::optional(c.median_ms / first->median_ms)
                                                             : std::nullopt);
                     }});
  for (CellColumn& c : columns) {
    if (c.column.name == "median_ms") c.column.heading = "frame";
    if (c.column.name == "simulate_ms") c.column.heading = "simulate";
  }
  Section section = section_of(
      cells, columns, stem, sources, {{"layers", "size"}, {"model"}, {axis}, {"median_ms", "simulate_ms"}},
      {"frame: median wall time of a warm frame, in ms. simulate: median time of its simulation, in ms, measured by the device's timer."});
  Table& table = section.table;
  add_remarks(table, mark_remarks(cells));
  View view = view_of(cells);
  if (view == View{} && has_column(table, "triangles"))
    view = {.x = "triangles",
            .y = table.layout.values,
            .series = {axis},
            .panels = table.layout.blocks,
            .x_scale = "log",
            .y_scale = "log"};
  section.plots = plots_of(table, cells, view, *sources.notes);
  Section shares{shares_of(cells, topologies), {}};
  shares.table.subtitle = table.subtitle;
  shares.table.stem = stem + "-shares";
  return {std::move(section), std::move(shares)};
}

namespace {

constexpr std::string_view ratio_mark = "_ratio", processor_mark = "_processor_ratio";

Value positive(double value) {
  return number_value(value > 0 ? std::optional(value) : std::nullopt);
}

/// Returns the line of the baseline `baseline`, to which the row has the ratio `ratio`.
std::vector<Value> solver_line(const Row& row, const std::string& baseline, const Metric& ratio) {
  const auto theirs = row.samples.find(baseline);
  const auto shared = row.metrics.find(baseline + std::string(processor_mark));
  return {text_value(row.device),
          text_value(value_at(row.axes, "model")),
          text_value(value_at(row.axes, axis)),
          text_value(row.variant),
          text_value(value_at(row.axes, "dynamics.substeps")),
          positive(median(frame_ms(row))),
          text_value(baseline),
          positive(theirs == row.samples.end() ? 0 : median(theirs->second.wall_ms)),
          positive(ratio.value),
          number_value(ratio.low),
          number_value(ratio.high),
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
  show_interval(table, "ratio");
  const auto key = [&](const std::vector<Value>& line) {
    std::vector<std::string> texts;
    for (const std::string& name : table.layout.rows)
      texts.push_back(line[std::size_t(column_of(table, name))].data);
    return texts;
  };
  std::ranges::stable_sort(table.lines, {}, key);
  table.remarks = {
      "Our solver and each baseline take turns to compute the same time steps from the same state. The ratio is the baseline's time divided by our time: the median over the rounds, with its 95% interval. The ratio by CPU time is the baseline's CPU time divided by our CPU time per core, which is our CPU time divided by the number of cores. serial-o3 is C++ compiled with -O3. serial-fast is C++ compiled with -O3 -march=native -ffast-math. The serial baselines use floats unless the name contains double. eigen-...-1 and eigen-...-2 use Eigen with one and two threads, compiled with -O3 -march=native."};
  return table;
}

}  // namespace pelage
