// Makes the report section (a table and its plots) of an experiment that compares mass-spring topologies.
#include <fmt/format.h>

#include <algorithm>

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

}  // namespace pelage
