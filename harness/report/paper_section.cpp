// Makes the report section that compares our frame rates with published ones, in the layout of the paper's
// table.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "harness/measure/provenance.hpp"
#include "harness/report/case_table.hpp"
#include "harness/report/sections.hpp"

namespace pelage {
namespace {

std::optional<double> ms_of(std::optional<double> fps) {
  return fps && *fps > 0 ? std::optional(1000 / *fps) : std::nullopt;
}

CellColumn of_paper(const char* name, std::optional<double> (*number)(const Metric& paper)) {
  return {{name, name}, [number](const Cell& c) {
            const Metric* paper = c.metric("paper_fps");
            return number_value(paper ? number(*paper) : std::nullopt);
          }};
}

CellColumn of_ratio(const char* name, std::optional<double> (*number)(const Ratio& ratio)) {
  return {{name, name}, [number](const Cell& c) {
            const auto ratio = ratio_of(c);
            return number_value(ratio ? number(*ratio) : std::nullopt);
          }};
}

std::vector<CellColumn> paper_columns(const std::vector<Cell>& cells) {
  std::vector<CellColumn> columns = case_columns(cells);
  // Removes the columns of the metric paper_fps and of its limits. The columns below replace them.
  std::erase_if(columns, [](const CellColumn& c) { return c.column.name.starts_with("paper_fps"); });
  for (CellColumn& c : columns)
    if (c.column.name == "fps") c.column.heading = "ours";
  columns.push_back({{"paper_relation", "paper_relation"}, [](const Cell& c) {
                       const Metric* paper = c.metric("paper_fps");
                       return text_value(paper ? paper->relation : "");
                     }});
  columns.push_back({{"paper_fps", "paper"}, [](const Cell& c) {
                       const Metric* paper = c.metric("paper_fps");
                       if (!paper) return number_value({});
                       return Value{fmt::format("{:g}", paper->value), published_text(*paper)};
                     }});
  columns.push_back(of_paper("paper_fps_low", [](const Metric& m) { return m.low; }));
  columns.push_back(of_paper("paper_fps_high", [](const Metric& m) { return m.high; }));
  columns.push_back(of_paper("paper_ms", [](const Metric& m) { return ms_of(m.value); }));
  columns.push_back(of_paper("paper_ms_low", [](const Metric& m) { return ms_of(m.high); }));
  columns.push_back(of_paper("paper_ms_high", [](const Metric& m) { return ms_of(m.low); }));
  columns.push_back({{"ratio", "ratio"}, [](const Cell& c) {
                       const auto ratio = ratio_of(c);
                       if (!ratio) return number_value({});
                       Value value = number_value(ratio->value);
                       value.data = ratio->relation + value.data;
                       value.shown = ratio->relation + (ratio->relation.empty() ? "" : " ") + value.shown;
                       return value;
                     }});
  columns.push_back(of_ratio("ratio_low", [](const Ratio& r) { return r.low; }));
  columns.push_back(of_ratio("ratio_high", [](const Ratio& r) { return r.high; }));
  return columns;
}

/// Returns whether the experiment's tables and plots show all its variants side by side.
bool shows_variants(const View& view) {
  return std::ranges::any_of(
      view_lists, [&](const auto& list) { return std::ranges::count(view.*list.second, "variant") > 0; });
}

Section paper_section(std::vector<Cell> cells, const std::string& stem, const Sources& sources) {
  sort_cells(cells);  // by the number of triangles, like the papers' tables
  const Cell& any = cells.front();
  const Experiment experiment = shipped_experiment(any.experiment).value_or(Experiment{});
  View view = view_of(cells);
  std::vector<std::string> remarks{
      "Frames per second: 1000 divided by the median wall time of a warm frame in ms. The wall time lasts from the frame's first enqueued kernel to the end of its last kernel.",
  };
  const bool every_variant = shows_variants(view);
  if (!every_variant) remarks.emplace_back("Ratio: ours divided by the paper's.");
  if (!experiment.hardware.empty())
    remarks.push_back(fmt::format("The paper's frame rates are from {}, measured on {}.",
                                  experiment.table.empty() ? "the paper" : experiment.table,
                                  experiment.hardware));
  Layout layout{{"layers"}, {"model"}, {"size"}, {"fps", "paper_fps", "ratio"}};
  if (every_variant) layout.groups = view.columns, layout.values = view.values;
  Section section = section_of(cells, paper_columns(cells), stem, sources, layout, remarks);
  Table& table = section.table;
  add_remarks(table, mark_remarks(cells));
  if (!any.reading().empty()) table.title += ", " + any.reading() + " reading";
  if (!any.reading().empty()) table.stem += "-" + any.reading();
  if (!every_variant && any.variant != default_variant) table.stem += "-" + file_name_of(any.variant);
  if (view.x.empty() && has_column(table, "triangles")) {
    view.x = "triangles";
    if (view.panels.empty()) view.panels = table.layout.blocks;
    view.x_scale = view.y_scale = "log";
  }
  section.plots = plots_of(table, cells, view, *sources.notes);
  for (PlotSpec& plot : section.plots)
    if (plot.y == "median_ms") plot.published = "paper_ms", plot.published_label = "paper";
  return section;
}

}  // namespace

std::vector<Section> paper_sections(const std::vector<Cell>& cells, const std::string& stem,
                                    const Sources& sources) {
  std::map<std::pair<std::string, std::string>, std::vector<Cell>> groups;
  const bool every_variant = shows_variants(view_of(cells));
  for (const Cell& c : cells) groups[{c.reading(), every_variant ? "" : c.variant}].push_back(c);
  std::vector<Section> sections;
  sections.reserve(groups.size());
  for (const auto& [key, group] : groups) sections.push_back(paper_section(group, stem, sources));
  return sections;
}

}  // namespace pelage
