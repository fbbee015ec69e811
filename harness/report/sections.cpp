#include "harness/report/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

#include "harness/error.hpp"
#include "harness/measure/provenance.hpp"
#include "harness/report/answer.hpp"
#include "harness/report/case_table.hpp"

namespace pelage {
namespace {

/// Returns the beginning of the file names for a group of cells, such as "scaling-up-z-mine-800x600": for
/// each key that the user changed, the last part of the key and the value; for `model` and `size` only the
/// value.
std::string stem_of(const Cell& cell, const Sources& sources) {
  std::string stem = cell.experiment;
  if (sources.several_devices) stem += "-" + cell.device;
  if (sources.several_hosts) stem += "-" + cell.host;
  for (const auto& [key, value] : cell.overrides) {
    if (key == "model")
      stem += "-" + std::filesystem::path(value).stem().string();
    else
      stem += (key == "size" ? "-" : fmt::format("-{}-", key.substr(key.rfind('.') + 1))) + value;
  }
  return file_name_of(stem);
}

/// Returns the ratios of the variants that were measured in turns with the OpenGL baseline, and the times of
/// the other variants.
std::vector<Section> with_baseline(const std::vector<Cell>& cells, const std::string& stem,
                                   const Sources& sources) {
  std::set<std::string> variants;
  for (const Cell& c : cells)
    if (c.metrics.contains("opengl_ratio")) variants.insert(c.variant);
  std::vector<Cell> compared, others;
  for (const Cell& c : cells) (variants.contains(c.variant) ? compared : others).push_back(c);
  std::vector<Section> sections = ratio_sections(compared, stem, sources);
  if (!others.empty()) std::ranges::move(case_sections(others, stem, sources), std::back_inserter(sections));
  return sections;
}

std::vector<Section> of_group(const std::vector<Cell>& cells, const std::string& stem,
                              const Sources& sources) {
  const auto any = [&](auto members, const char* name) {
    return std::ranges::any_of(cells, [&](const Cell& c) { return (c.*members).contains(name); });
  };
  if (any(&Cell::metrics, "opengl_ratio")) return with_baseline(cells, stem, sources);
  if (any(&Cell::metrics, "paper_fps")) return paper_sections(cells, stem, sources);
  if (any(&Cell::axes, "dynamics.topology") && any(&Cell::axes, "layers"))
    return topology_sections(cells, stem, sources);
  return case_sections(cells, stem, sources);
}

/// Makes the file names unique: of two sections with the file name x, the second one is renamed to x-2.
void separate(std::vector<Section>& sections) {
  std::map<std::string, int> uses;
  for (Section& section : sections) {
    const std::string stem = section.table.stem;
    const int use = ++uses[stem];
    if (use == 1) continue;
    section.table.stem = fmt::format("{}-{}", stem, use);
    for (PlotSpec& plot : section.plots) plot.stem = fmt::format("{}-{}", plot.stem, use);
  }
}

}  // namespace

std::vector<Section> sections_of(const std::vector<Cell>& cells, const Sources& sources) {
  std::map<std::tuple<std::string, std::string, std::string, std::string>, std::vector<Cell>> groups;
  for (const Cell& c : cells) groups[{c.experiment, c.device, c.host, changes_of(c.overrides)}].push_back(c);
  std::vector<Section> sections;
  for (const auto& [key, group] : groups) {
    std::vector<Section> own = of_group(group, stem_of(group.front(), sources), sources);
    own.front().table.answer = answer_of(group);
    add_remarks(own.front().table, {equal_pictures_remark(group)});
    std::ranges::move(own, std::back_inserter(sections));
  }
  separate(sections);
  return sections;
}

std::string title_of(const std::vector<Cell>& cells) {
  for (auto c = cells.rbegin(); c != cells.rend(); ++c)
    if (!c->title.empty()) return c->title;
  const std::string name = cells.front().experiment;
  const std::string title = shipped_experiment(name).value_or(Experiment{}).title;
  return title.empty() ? name : title;
}

Section section_of(const std::vector<Cell>& cells, const std::vector<CellColumn>& columns,
                   const std::string& stem, const Sources& sources, const Layout& layout,
                   std::vector<std::string> remarks) {
  Section section{table_of(cells, columns), {}};
  Table& table = section.table;
  table.title = title_of(cells);
  table.subtitle = subtitle_of(cells, sources.several_hosts);
  table.stem = stem;
  table.layout = {present(table, layout.blocks), present(table, layout.rows), present(table, layout.groups),
                  present(table, layout.values)};
  add_varying_keys(table, cells);
  std::vector<std::string>& rows = table.layout.rows;
  if (const auto model = std::find(rows.begin(), rows.end(), "model");
      model != rows.end() && has_column(table, "triangles"))
    rows.insert(model + 1, "triangles");
  if (rows.empty()) rows = {has_column(table, "model") ? "model" : "variant"};
  table.remarks = std::move(remarks);
  add_footnotes(table, sources.note);
  return section;
}

void add_remarks(Table& table, const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks)
    if (!remark.empty()) table.remarks.push_back(remark);
}

std::vector<std::string> present(const Table& table, std::vector<std::string> names) {
  std::erase_if(names, [&](const auto& name) { return !has_column(table, name); });
  return names;
}

void add_footnotes(Table& table, const ModelNote& note) {
  const int model = column_of(table, "model");
  if (model < 0 || !note) return;
  const auto& rows = table.layout.rows;
  const bool shown = std::find(rows.begin(), rows.end(), "model") != rows.end();
  std::map<std::string, std::string> marks;
  for (auto& line : table.lines) {
    Value& value = line[std::size_t(model)];
    const std::string text = note(value.data);
    if (text.empty()) continue;
    const auto [mark, added] = marks.emplace(value.data, "");
    if (added && !shown) table.remarks.push_back(fmt::format("{}: {}.", value.data, text));
    if (!shown) continue;
    if (added) {
      // marks of footnotes: a to z, then aa, ab, ...
      for (std::size_t n = marks.size(); n > 0; n = (n - 1) / 26)
        mark->second.insert(mark->second.begin(), char('a' + (n - 1) % 26));
      table.footnotes.emplace_back(mark->second, fmt::format("{}: {}", value.data, text));
    }
    value.mark = mark->second;
  }
}

View view_of(const std::vector<Cell>& cells) {
  for (auto c = cells.rbegin(); c != cells.rend(); ++c)
    if (!c->view.is_null()) return view_from_json(c->view);
  return shipped_experiment(cells.front().experiment).value_or(Experiment{}).view;
}

}  // namespace pelage
