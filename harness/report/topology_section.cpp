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

std::string all_but_topology(Cell cell) {
  cell.axes.erase(axis);
  return name_of(cell) + "\n" + cell.variant;
}

/// Returns the topologies of the cells in the order of the key's choices.
std::vector<std::string> topologies_of(const std::vector<Cell>& cells, const Table& table) {
  std::vector<std::string> names;
  for (const std::string& name : table.columns[std::size_t(column_of(table, axis))].order)
    if (std::any_of(cells.begin(), cells.end(), [&](const Cell& c) { return c.axis(axis) == name; }))
      names.push_back(name);
  return names;
}

/// Returns the cell with the topology `first` and a time that is otherwise like `like`; null if there is
/// none.
const Cell* first_of(const std::vector<Cell>& cells, const Cell& like, const std::string& first) {
  const std::string place = all_but_topology(like);
  const auto found = std::find_if(cells.begin(), cells.end(), [&](const Cell& c) {
    return c.axis(axis) == first && timed(c) && all_but_topology(c) == place;
  });
  return found == cells.end() ? nullptr : &*found;
}

std::optional<double> simulate_ms(const Cell& c) {
  const auto found = c.phase_ms.find("simulate");
  return found == c.phase_ms.end() ? std::nullopt : std::optional(found->second);
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
      if (const Cell* first = first_of(cells, c, topologies.front()))
        ratios.push_back(c.median_ms / first->median_ms);
      if (!simulate_ms(c)) continue;
      shares.push_back(*simulate_ms(c) / c.median_ms);
      if (shares.back() >= most)
        most = shares.back(), worst = all_but_topology(c).substr(0, all_but_topology(c).find('\n'));
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
                           topologies.empty() ? nullptr : first_of(cells, c, topologies.front());
                       return number_value(first && timed(c) ? std::optional(c.median_ms / first->median_ms)
                                                             : std::nullopt);
                     }});
  for (CellColumn& c : columns) {
    if (c.column.name == "median_ms") c.column.heading = "frame";
    if (c.column.name == "simulate_ms") c.column.heading = "simulate";
  }
  Section section = section_of(
      cells, columns, stem, sources,
      {{"layers", "size"}, {"model", "triangles"}, {axis}, {"median_ms", "simulate_ms"}},
      {"frame: median wall time of a warm frame, in ms. simulate: median time of its simulation, in ms, measured by the device's timer."});
  Table& table = section.table;
  View view = view_of(cells);
  if (view == View{} && column_of(table, "triangles") >= 0)
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

Value text_of(const std::map<std::string, std::string>& axes, const std::string& name) {
  const auto found = axes.find(name);
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
