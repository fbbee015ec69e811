#include "harness/page/study_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>

#include "harness/base/numbers.hpp"
#include "harness/measure/provenance.hpp"

namespace pelage {
namespace {

using Number = std::function<std::optional<double>(const Cell&)>;
using Text = std::function<std::string(const Cell&)>;

std::optional<double> metric(const Cell& cell, const std::string& name) {
  const auto found = cell.metrics.find(name);
  return found == cell.metrics.end() ? std::nullopt : std::optional(found->second.value);
}

std::optional<double> frame_ms_of(const Cell& cell) {
  return cell.median_ms > 0 ? std::optional(cell.median_ms) : std::nullopt;
}

std::string topology(const Cell& cell) {
  return cell.axis("dynamics.topology");
}

std::string solver(const Cell& cell) {
  const std::string name = cell.axis("dynamics.solver");
  return name.empty() ? cell.variant : name;
}

/// Functions that compute the panel, the line and the coordinates of a chart point from a cell.
struct Study {
  Text panel, line;
  Number x, y;
  bool interval = false;  ///< true: y is the frame time, and the chart shows its 95% interval
};

ChartPoint point_of(const Study& study, const Cell& cell, double x, double y) {
  ChartPoint point{x, y, {}, {}, cell.index};
  if (study.interval) point.low = cell.interval_ms.low, point.high = cell.interval_ms.high;
  return point;
}

/// Adds one point per cell to the chart. Sorts the panels and their lines by natural_less().
void fill(Chart& chart, const std::vector<Cell>& cells, const Study& study) {
  const auto less = [](const std::string& a, const std::string& b) { return natural_less(a, b); };
  std::map<std::string, std::map<std::string, std::vector<ChartPoint>, decltype(less)>, decltype(less)> found(
      less);
  for (const Cell& cell : cells)
    if (const auto x = study.x(cell), y = study.y(cell); x && y)
      found.try_emplace(study.panel(cell), less)
          .first->second[study.line(cell)]
          .push_back(point_of(study, cell, *x, *y));
  for (auto& [title, lines] : found) {
    ChartPanel panel{title, "", {}};
    for (auto& [label, points] : lines) {
      std::stable_sort(points.begin(), points.end(),
                       [](const ChartPoint& a, const ChartPoint& b) { return a.x < b.x; });
      panel.lines.push_back(
          {label, label, chart.categories.empty() ? Mark::line : Mark::points, std::move(points)});
    }
    chart.panels.push_back(std::move(panel));
  }
}

/// Returns the chart for Figures 9 to 11 of Banisch and Wüthrich (2006). For each topology it shows the frame
/// time, the simulation time, and the frame time that the paper reports.
Chart update_time(const std::vector<Cell>& cells) {
  Chart chart{.y_label = "update time, ms"};
  for (const Cell& cell : cells)
    if (std::find(chart.categories.begin(), chart.categories.end(), topology(cell)) == chart.categories.end())
      chart.categories.push_back(topology(cell));
  std::sort(chart.categories.begin(), chart.categories.end(), natural_less);
  const auto x = [&](const Cell& cell) -> std::optional<double> {
    return double(std::find(chart.categories.begin(), chart.categories.end(), topology(cell)) -
                  chart.categories.begin());
  };
  const Text model = [](const Cell& cell) { return cell.axis("model"); };
  fill(chart, cells, {model, [](const Cell& c) { return solver(c) + ", frame"; }, x, frame_ms_of, true});
  Chart simulation{.categories = chart.categories};
  fill(simulation, cells,
       {model, [](const Cell& c) { return solver(c) + ", simulation"; }, x,
        [](const Cell& c) {
          const auto phase = c.phase_ms.find("simulate");
          return phase == c.phase_ms.end() ? std::nullopt : std::optional(phase->second);
        }});
  Chart paper{.categories = chart.categories};
  fill(paper, cells,
       {model, [](const Cell&) { return "from the paper's text, frame"; }, x,
        [](const Cell& c) {
          const auto fps = c.paper_fps();
          return fps && fps->value > 0 ? std::optional(1000 / fps->value) : std::nullopt;
        }});
  for (Chart* more : {&simulation, &paper})
    for (ChartPanel& panel : more->panels)
      for (ChartPanel& own : chart.panels)
        if (own.title == panel.title)
          for (ChartLine& line : panel.lines) {
            if (more == &paper) line.mark = Mark::published;
            own.lines.push_back(std::move(line));
          }
  for (ChartPanel& panel : chart.panels)
    for (ChartLine& line : panel.lines) line.key = line.label.substr(0, line.label.find(", "));
  return chart;
}

Chart energy(const std::vector<Cell>& cells) {
  Chart chart{.x_label = "time, s", .y_label = "energy of springs and masses, uJ", .y_scale = "log"};
  constexpr std::string_view mark = "energy_uJ_at_";
  std::map<std::string, ChartPanel> panels;
  for (const Cell& cell : cells) {
    ChartLine line{solver(cell), solver(cell), Mark::line, {}};
    for (const auto& [name, value] : cell.metrics)
      if (name.starts_with(mark) && value.value > 0)
        line.points.push_back({std::atof(name.c_str() + mark.size()), value.value, {}, {}, cell.index});
    std::sort(line.points.begin(), line.points.end(),
              [](const ChartPoint& a, const ChartPoint& b) { return a.x < b.x; });
    if (!line.points.empty()) panels[topology(cell)].lines.push_back(std::move(line));
  }
  for (auto& [title, panel] : panels) {
    panel.title = title;
    std::sort(panel.lines.begin(), panel.lines.end(),
              [](const ChartLine& a, const ChartLine& b) { return a.label < b.label; });
    chart.panels.push_back(std::move(panel));
  }
  return chart;
}

Chart chart_of_study(const std::string& experiment, const std::vector<Cell>& cells) {
  const auto of_metric = [](const char* name) { return [=](const Cell& c) { return metric(c, name); }; };
  if (experiment == "banisch2006-update-time") return update_time(cells);
  if (experiment == "banisch2006-energy") return energy(cells);
  Chart chart{.x_scale = "log", .y_scale = "log"};
  if (experiment == "banisch2006-work-precision") {
    chart.x_label = "ms per simulated second", chart.y_label = "rms error after 1 s, of the fur's length";
    fill(chart, cells, {topology, solver, frame_ms_of, of_metric("error_rms")});
  } else if (experiment == "banisch2006-longest-step") {
    chart.x_label = "stiffness of the sticks, N/m", chart.y_label = "longest stable step, ms";
    const Number stiffness = [](const Cell& c) {
      return number_of(c.reading().substr(1));  // reading() is "k" followed by the stiffness in N/m
    };
    fill(chart, cells, {topology, solver, stiffness, of_metric("longest_step_ms")});
  } else if (experiment == "banisch2006-mesh-size") {
    chart.x_label = "triangles", chart.y_label = "simulation of a sixtieth of a second, ms";
    chart.guide = 1000.0 / 60;
    fill(chart, cells, {solver, topology, of_metric("triangles"), frame_ms_of, true});
  }
  return chart;
}

std::string amount(const std::string& key, double value) {
  if (key == "triangles")
    return value < 1e6 ? fmt::format("{:.0f}k triangles", value / 1e3)
                       : fmt::format("{:.1f}M triangles", value / 1e6);
  return key == "pixels" ? fmt::format("{:.2g} Mpixel", value / 1e6) : fmt::format("{:.0f} layers", value);
}

}  // namespace

std::vector<Chart> spring_charts(const std::vector<Cell>& cells) {
  static const std::map<std::string, std::string> titles{
      {"banisch2006-update-time", "Update times of Figures 9 to 11 of Banisch and Wuethrich 2006"},
      {"banisch2006-work-precision", "Error against cost of the solvers, per topology"},
      {"banisch2006-longest-step", "Longest stable step"},
      {"banisch2006-energy", "Energy over time"},
      {"banisch2006-mesh-size", "Cost of a frame's simulation against the size of the mesh"}};
  std::map<std::pair<std::string, std::string>, std::vector<Cell>> groups;
  for (const Cell& cell : cells)
    if (titles.contains(cell.experiment) && cell.overrides.empty() && cell.status == Status::ok)
      groups[{cell.experiment, cell.device}].push_back(cell);
  std::vector<Chart> charts;
  for (const auto& [key, group] : groups) {
    Chart chart = chart_of_study(key.first, group);
    chart.title = titles.at(key.first), chart.note = key.second;
    chart.stem = fmt::format("{}@{}", key.first, file_name_of(key.second));
    if (!chart.panels.empty()) charts.push_back(std::move(chart));
  }
  return charts;
}

Chart scaling_chart(const std::vector<Cell>& cells) {
  Chart chart{.title = "Frame time against layers, pixels and triangles",
              .stem = "scaling",
              .x_scale = "log",
              .y_label = "frame time, ms",
              .y_scale = "log"};
  if (!cells.empty()) chart.note = cells.front().device;
  const std::map<std::string, Number> quantities{
      {"layers", [](const Cell& c) { return number_of(c.axis("layers")); }},
      {"pixels", [](const Cell& c) { return number_of(c.axis("size")); }},
      {"triangles", [](const Cell& c) { return metric(c, "triangles"); }}};
  for (const char* x : {"layers", "pixels", "triangles"}) {
    const Text rest = [&](const Cell& cell) {
      std::string text;
      for (const auto& [name, number] : quantities)
        if (name != x)
          text += fmt::format("{}{}", text.empty() ? "" : ", ", amount(name, number(cell).value_or(0)));
      return text;
    };
    Chart one;
    fill(one, cells, {[](const Cell&) { return ""; }, rest, quantities.at(x), frame_ms_of, true});
    for (ChartPanel& panel : one.panels) {
      std::erase_if(panel.lines, [](const ChartLine& line) {
        return line.points.size() < 2 || line.points.front().x == line.points.back().x;
      });
      panel.x_label = x;
      if (!panel.lines.empty()) chart.panels.push_back(std::move(panel));
    }
  }
  return chart;
}

}  // namespace pelage
