// Makes the report section of an experiment that times our OpenCL pipeline in turns with the OpenGL baseline,
// which is the pipeline of the experiment's paper. Ratios are OpenGL time divided by OpenCL time.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "harness/report/case_table.hpp"
#include "harness/report/sections.hpp"

namespace pelage {
namespace {

const Metric* ratio_of_pipelines(const Cell& c) {
  return c.status == Status::ok ? c.metric("opengl_ratio") : nullptr;
}

/// Returns the geometric mean of the ratios of each separate run; nothing if the cells have different numbers
/// of runs, or too few runs for an interval.
std::vector<double> means_of_runs(const std::vector<const Cell*>& cells) {
  const std::size_t count = cells.front()->runs.at("opengl_ratio").size();
  std::vector<double> means;
  for (std::size_t run = 0; run < count; ++run) {
    std::vector<double> ratios;
    ratios.reserve(cells.size());
    for (const Cell* c : cells) {
      const std::vector<double>& own = c->runs.at("opengl_ratio");
      if (own.size() != count) return {};
      ratios.push_back(own[run]);
    }
    means.push_back(geometric_mean(ratios));
  }
  return has_mean_interval(means.size()) ? means : std::vector<double>{};
}

std::string mean_interval_text(const std::vector<const Cell*>& cells) {
  const std::vector<double> means = means_of_runs(cells);
  if (means.empty()) return "no interval, because that needs three separate runs (--repeat 3)";
  const Interval interval = mean_interval(means);
  return fmt::format("95% interval {:.2f} to {:.2f} over {} separate runs", interval.low, interval.high,
                     means.size());
}

/// Returns a sentence about the mean and the minimum of the ratios for each reading and value of the axis
/// "effects".
std::vector<std::string> means_of(const std::vector<Cell>& cells) {
  std::map<std::string, std::vector<const Cell*>> readings;
  for (const Cell& c : cells) {
    const std::string effects = c.axis("effects") == "none" ? "without effects" : "";
    readings[c.reading() + (c.reading().empty() || effects.empty() ? "" : ", ") + effects].push_back(&c);
  }
  std::vector<std::string> sentences;
  for (const auto& [reading, members] : readings) {
    std::vector<double> ratios;
    std::vector<const Cell*> known;
    for (const Cell* c : members)
      if (const Metric* ratio = ratio_of_pipelines(*c)) {
        ratios.push_back(ratio->value);
        known.push_back(c);
      }
    const auto least = std::ranges::min_element(ratios);
    const std::string name = reading.empty() ? "" : reading + ": ";
    sentences.push_back(
        !known.empty()
            ? fmt::format(
                  "{}the ratios have the geometric mean {:.2f} over {} of {} cells ({}) and the minimum {:.2f} ({}).",
                  name, geometric_mean(ratios), ratios.size(), members.size(), mean_interval_text(known),
                  *least, name_of(*known[std::size_t(least - ratios.begin())], "reading"))
            : fmt::format("{}none of the {} cells has a ratio of OpenGL time to OpenCL time.", name,
                          members.size()));
  }
  return sentences;
}

}  // namespace

std::vector<Section> ratio_sections(const std::vector<Cell>& given, const std::string& stem,
                                    const Sources& sources) {
  std::vector<Cell> cells = given;
  sort_cells(cells);
  auto columns = case_columns(cells);
  for (CellColumn& c : columns)
    if (c.column.name == "opengl_ratio")
      c = {{"opengl_ratio", "ratio"}, [](const Cell& cell) {
             const Metric* ratio = ratio_of_pipelines(cell);
             if (!ratio) return Value{"", std::string(to_text(cell.status)), cell.reason, "", true};
             return Value{fmt::format("{:.6g}", ratio->value),
                          fmt::format("{:.2f}{}{}", ratio->value, marks_of(cell), interval_text(*ratio))};
           }};
  const auto renderer = std::ranges::find_if(cells, [](const Cell& c) { return !c.renderer.empty(); });
  Section section = section_of(
      cells, columns, stem + "-ratio", sources,
      {{"reading", "effects"}, {"model"}, {"layers", "size"}, {"opengl_ratio"}},
      {fmt::format(
          "Time of OpenGL, the papers' kind of program ({}, on the same device or processor), divided by ours, for the same picture in the same round: median over the rounds, and its 95% interval.",
          renderer == cells.end() ? "OpenGL" : renderer->renderer)});
  Table& table = section.table;
  add_remarks(table, mark_remarks(cells));
  add_remarks(table, means_of(cells));
  View view = view_of(cells);
  if (view == View{})
    view = {.x = has_column(table, "model") ? "model" : "",
            .y = {"opengl_ratio"},
            .panels = table.layout.blocks,
            .y_scale = "log"};
  if (std::find(view.y.begin(), view.y.end(), "opengl_ratio") == view.y.end())
    view.y.insert(view.y.begin(), "opengl_ratio");
  section.plots = plots_of(table, cells, view, *sources.notes);
  for (PlotSpec& plot : section.plots)
    if (plot.y == "opengl_ratio") {
      plot.guide = 1;
      plot.y_label = "times as fast as OpenGL";
      plot.stem = table.stem;
      plot.title = "Speed relative to OpenGL: " + table.subtitle;
      if (renderer != cells.end())
        plot.note += " against " + renderer->renderer.substr(0, renderer->renderer.find(" ("));
    }
  return {std::move(section)};
}

}  // namespace pelage
