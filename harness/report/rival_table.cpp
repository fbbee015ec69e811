#include "harness/report/rival_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "harness/report/csv.hpp"

namespace pelage {
namespace {

using Group = std::tuple<std::string, std::string, std::string>;  // experiment, device, host

/// Data of the OpenGL baseline that report cells do not contain: its times and the name of its renderer.
struct Theirs {
  std::map<std::pair<Group, std::string>, std::vector<double>> wall_ms;  ///< by case
  std::map<Group, std::string> renderer;
};

Theirs theirs_of(const std::vector<FoundRow>& rows) {
  Theirs all;
  for (const FoundRow& found : rows) {
    const Row& row = found.row;
    const Group group{row.experiment, row.device, row.provenance.value("host", std::string())};
    const auto samples = row.samples.find("opengl");
    if (samples == row.samples.end()) continue;
    std::vector<double>& into = all.wall_ms[{group, row.case_name}];
    into.insert(into.end(), samples->second.wall_ms.begin(), samples->second.wall_ms.end());
    all.renderer[group] = row.provenance.value("opengl_renderer", std::string());
  }
  return all;
}

double number(const std::string& text) {
  return std::atof(text.c_str());
}

auto order(const RivalTable::Column& c) {
  return std::tuple(number(c.layers), number(c.size), c.size);
}

auto order(const RivalTable::Row& row) {
  return std::tuple(row.reading != "default", row.reading, row.triangles, row.model);
}

template <class List, class Same>
std::size_t place_of(List& list, const Same& same, const typename List::value_type& otherwise) {
  const auto found = std::find_if(list.begin(), list.end(), same);
  const auto place = std::size_t(found - list.begin());
  if (found == list.end()) list.push_back(otherwise);
  return place;
}

void summarize(RivalTable& table) {
  for (const RivalTable::Row& row : table.rows) {
    const std::size_t place = place_of(table.summary, [&](const auto& s) { return s.reading == row.reading; },
                                       {row.reading, 0, 0, 0, 0, ""});
    RivalTable::Summary& s = table.summary[place];
    for (std::size_t c = 0; c < row.entries.size(); ++c) {
      if (!row.entries[c]) continue;
      ++s.cells;
      if (!row.entries[c]->ratio) continue;
      const double ratio = row.entries[c]->ratio->value;
      s.mean += std::log(ratio);  // its exponential below
      if (s.timed++ > 0 && ratio >= s.least) continue;
      s.least = ratio;
      s.least_cell =
          fmt::format("{}, {} layers, {}", row.model, table.columns[c].layers, table.columns[c].size);
    }
  }
  for (RivalTable::Summary& s : table.summary) s.mean = s.timed > 0 ? std::exp(s.mean / double(s.timed)) : 0;
}

void compare_readings(RivalTable& table) {
  RivalTable::Overhead& o = table.overhead;
  for (const RivalTable::Row& coat : table.rows)
    for (const RivalTable::Row& plain : table.rows) {
      if (coat.reading != "default" || plain.reading != "plain" || coat.model != plain.model) continue;
      for (std::size_t c = 0; c < table.columns.size(); ++c) {
        const auto &a = coat.entries[c], &b = plain.entries[c];
        if (!a || !b || !a->ratio || !b->ratio || !a->opengl_ms || !b->opengl_ms) continue;
        ++o.cells;
        o.ours += std::log(a->cell.median_ms / b->cell.median_ms);
        o.opengl += std::log(*a->opengl_ms / *b->opengl_ms);
      }
    }
  if (o.cells == 0) return;
  o.ours = std::exp(o.ours / double(o.cells));
  o.opengl = std::exp(o.opengl / double(o.cells));
}

RivalTable build(const Group& group, const std::vector<Cell>& cells, const Theirs& theirs) {
  RivalTable table;
  std::tie(table.experiment, table.device, table.host) = group;
  if (const auto found = theirs.renderer.find(group); found != theirs.renderer.end())
    table.renderer = found->second;
  for (const Cell& c : cells)
    place_of(table.columns,
             [&](const auto& column) {
               return column.layers == c.axis("layers") && column.size == c.axis("size");
             },
             {c.axis("layers"), c.axis("size")});
  std::sort(table.columns.begin(), table.columns.end(),
            [](const auto& a, const auto& b) { return order(a) < order(b); });
  for (const Cell& c : cells) {
    const std::size_t at = place_of(
        table.rows, [&](const auto& r) { return r.reading == c.reading() && r.model == c.axis("model"); },
        {c.reading(), c.axis("model"), 0, {}});
    RivalTable::Row& row = table.rows[at];
    row.entries.resize(table.columns.size());
    RivalTable::Entry entry{c, {}, {}};
    if (const auto found = c.metrics.find("triangles"); found != c.metrics.end())
      row.triangles = found->second.value;
    const auto ratio = c.metrics.find("opengl_ratio");
    if (c.status == Status::ok && ratio != c.metrics.end()) entry.ratio = ratio->second;
    if (const auto found = theirs.wall_ms.find({group, c.case_name});
        found != theirs.wall_ms.end() && !found->second.empty())
      entry.opengl_ms = median(found->second);
    for (std::size_t k = 0; k < table.columns.size(); ++k)
      if (table.columns[k].layers == c.axis("layers") && table.columns[k].size == c.axis("size"))
        row.entries[k] = entry;
  }
  std::sort(table.rows.begin(), table.rows.end(),
            [](const auto& a, const auto& b) { return order(a) < order(b); });
  summarize(table);
  compare_readings(table);
  return table;
}

std::string head_of(const RivalTable::Column& column) {
  return fmt::format("{} layers, {}", column.layers, column.size);
}

std::string shown(const std::optional<RivalTable::Entry>& entry) {
  if (!entry) return "-";
  if (!entry->ratio) return std::string(to_text(entry->cell.status));
  const Metric& r = *entry->ratio;
  return fmt::format("{:.2f}{} [{:.2f}, {:.2f}]", r.value, entry->cell.converged ? "" : "*",
                     r.low.value_or(0), r.high.value_or(0));
}

std::string sentence(const RivalTable::Summary& s) {
  const std::string name = s.reading == "default" ? "" : s.reading + ": ";
  if (s.timed == 0)
    return fmt::format("{}none of the {} cells has a ratio of OpenGL time to OpenCL time.", name, s.cells);
  return fmt::format("{}geometric mean {:.2f} over {} of {} cells, least {:.2f} ({}).", name, s.mean, s.timed,
                     s.cells, s.least, s.least_cell);
}

std::string sentence(const RivalTable::Overhead& o) {
  return fmt::format(
      "Frames with curls and clumps take {:.2f} times the time of plain shells in OpenCL, and {:.2f} times "
      "in "
      "OpenGL (geometric means of {} cells).",
      o.ours, o.opengl, o.cells);
}

std::string legend_of(const RivalTable& table) {
  return fmt::format(
      "Time of the paper's pipeline ({}) divided by ours, for the same picture in the same round: median "
      "over "
      "the rounds, and its 95% interval.",
      table.renderer.empty() ? "OpenGL" : table.renderer);
}

}  // namespace

std::vector<RivalTable> rival_tables(const std::vector<FoundRow>& rows) {
  std::map<Group, std::vector<Cell>> groups;
  for (const Cell& c : cells_of(rows))
    if (c.overrides.empty() && c.axes.contains("model") && c.axes.contains("layers") &&
        c.axes.contains("size"))
      groups[{c.experiment, c.device, c.host}].push_back(c);
  const Theirs theirs = theirs_of(rows);
  std::vector<RivalTable> tables;
  for (const auto& [group, cells] : groups)
    if (std::any_of(cells.begin(), cells.end(),
                    [](const Cell& c) { return c.metrics.contains("opengl_ratio"); }))
      tables.push_back(build(group, cells, theirs));
  return tables;
}

std::string text_of(const RivalTable& table) {
  std::string text = fmt::format("{} on {}\n", table.experiment, table.device), reading;
  for (const RivalTable::Row& row : table.rows) {
    if (row.reading != reading) {
      reading = row.reading;
      text += fmt::format("\n{:<14}{:>9}", reading == "default" ? "model" : reading, "triangles");
      for (const RivalTable::Column& column : table.columns) text += fmt::format("  {:>22}", head_of(column));
      text += "\n";
    }
    text += fmt::format("{:<14}{:>9.0f}", row.model, row.triangles);
    for (const auto& entry : row.entries) text += fmt::format("  {:>22}", shown(entry));
    text += "\n";
  }
  text += fmt::format("\n{}\n", legend_of(table));
  for (const RivalTable::Summary& s : table.summary) text += sentence(s) + "\n";
  if (table.overhead.cells > 0) text += sentence(table.overhead) + "\n";
  return text;
}

std::string csv_of(const RivalTable& table) {
  std::string text =
      csv_line({"model", "triangles", "reading", "layers", "size", "device", "renderer", "status", "ours_ms",
                "opengl_ms", "ratio", "ratio_low", "ratio_high", "converged"});
  const auto number_of = [](std::optional<double> v) {
    return v ? fmt::format("{:.6g}", *v) : std::string();
  };
  for (const RivalTable::Row& row : table.rows)
    for (std::size_t k = 0; k < row.entries.size(); ++k) {
      if (!row.entries[k]) continue;
      const RivalTable::Entry& e = *row.entries[k];
      const Metric none, &r = e.ratio ? *e.ratio : none;
      const auto of = [&](std::optional<double> v) { return e.ratio ? number_of(v) : std::string(); };
      text += csv_line({row.model, fmt::format("{:.0f}", row.triangles), row.reading, table.columns[k].layers,
                        table.columns[k].size, table.device, table.renderer,
                        std::string(to_text(e.cell.status)), of(e.cell.median_ms), of(e.opengl_ms),
                        of(r.value), of(r.low), of(r.high), e.cell.converged ? "1" : "0"});
    }
  return text;
}

std::string html_of(const RivalTable& table) {
  std::string html =
      "<div class=\"wide\"><table>\n<thead><tr><th>Model</th><th>Triangles</th><th>Reading</th>";
  for (const RivalTable::Column& column : table.columns) html += fmt::format("<th>{}</th>", head_of(column));
  html += "</tr></thead>\n<tbody>\n";
  for (const RivalTable::Row& row : table.rows) {
    html += fmt::format("<tr><td>{}</td><td>{:.0f}</td><td>{}</td>", row.model, row.triangles, row.reading);
    for (const auto& entry : row.entries)
      html += fmt::format("<td class=\"{}\">{}</td>", entry && entry->ratio ? "ours" : "bad", shown(entry));
    html += "</tr>\n";
  }
  html += fmt::format("</tbody></table></div>\n<p class=\"soft\">{}", legend_of(table));
  for (const RivalTable::Summary& s : table.summary) html += fmt::format(" {}", sentence(s));
  if (table.overhead.cells > 0) html += fmt::format(" {}", sentence(table.overhead));
  return html + "</p>\n";
}

}  // namespace pelage
