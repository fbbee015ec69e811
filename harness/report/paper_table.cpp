#include "harness/report/paper_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "harness/experiment/experiment.hpp"
#include "harness/journal/provenance.hpp"
#include "harness/report/csv.hpp"
#include "harness/report/topology_table.hpp"
#include "harness/report/way_table.hpp"

namespace pelage {
namespace {

/// Compares by the leading number, so that "16" precedes "64" and "800x600" precedes "1680x1050".
bool by_number(const std::string& a, const std::string& b) {
  return std::tuple(std::atof(a.c_str()), a) < std::tuple(std::atof(b.c_str()), b);
}

std::vector<std::string> sorted_values(const std::vector<Cell>& cells, const std::string& key) {
  std::vector<std::string> values;
  values.reserve(cells.size());
  for (const Cell& c : cells) values.push_back(c.axis(key));
  std::sort(values.begin(), values.end(), by_number);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::string triangles_of(const Cell& cell) {
  const auto found = cell.metrics.find("triangles");
  return found == cell.metrics.end() ? "" : fmt::format("{:.0f}", found->second.value);
}

/// Sorts models by their triangle count, like the papers' tables.
std::vector<std::string> models_of(const std::vector<Cell>& cells) {
  std::vector<std::pair<double, std::string>> models;
  for (const Cell& c : cells) {
    const std::string model = c.axis("model");
    const double count = std::atof(triangles_of(c).c_str());
    const auto same =
        std::find_if(models.begin(), models.end(), [&](const auto& m) { return m.second == model; });
    if (same == models.end())
      models.emplace_back(count, model);
    else
      same->first = std::max(same->first, count);
  }
  std::stable_sort(models.begin(), models.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  names.reserve(models.size());
  for (auto& [count, name] : models) names.push_back(std::move(name));
  return names;
}

PaperTable build(const std::vector<Cell>& cells, const ModelNote& note) {
  PaperTable table;
  const Cell& any = cells.front();
  table.experiment = any.experiment;
  table.device = any.device;
  table.host = any.host;
  table.reading = any.reading();
  table.variant = any.variant;
  table.sizes = sorted_values(cells, "size");
  std::map<std::string, std::string> marks;
  for (const std::string& model : models_of(cells)) {
    const std::string text = note(model);
    if (text.empty()) continue;
    marks[model] = std::string(1, char('a' + int(marks.size())));
    table.footnotes.push_back(fmt::format("{} {}: {}", marks[model], model, text));
  }
  for (const std::string& layers : sorted_values(cells, "layers")) {
    PaperTable::Block block{layers, {}};
    for (const std::string& model : models_of(cells)) {
      PaperTable::Row row{model, "", marks.contains(model) ? marks[model] : "", {}};
      bool any_cell = false;
      for (const std::string& size : table.sizes) {
        const auto found = std::find_if(cells.begin(), cells.end(), [&](const Cell& c) {
          return c.axis("model") == model && c.axis("layers") == layers && c.axis("size") == size;
        });
        row.cells.push_back(found == cells.end() ? std::nullopt : std::optional(*found));
        any_cell = any_cell || found != cells.end();
        if (found != cells.end() && row.triangles.empty()) row.triangles = triangles_of(*found);
      }
      if (any_cell) block.rows.push_back(std::move(row));
    }
    table.blocks.push_back(std::move(block));
  }
  return table;
}

/// Three significant digits: "0.842", "12.3", "267".
std::string three(double value) {
  if (value <= 0) return "0";
  const int decimals = std::max(0, 2 - int(std::floor(std::log10(value) + 1e-9)));
  return fmt::format("{:.{}f}", value, std::min(decimals, 4));
}

CellText shown(const std::optional<Cell>& cell) {
  return cell ? cell_text(*cell) : CellText{"-", "-", "-"};
}

bool any_unconverged(const PaperTable& table) {
  for (const auto& block : table.blocks)
    for (const auto& row : block.rows)
      for (const auto& cell : row.cells)
        if (cell && cell->status == Status::ok && !cell->converged) return true;
  return false;
}

}  // namespace

CellText cell_text(const Cell& cell) {
  CellText text;
  const auto paper = cell.paper_fps();
  text.paper = paper ? published_text(*paper) : "-";
  text.ratio = "-";
  if (cell.status != Status::ok || cell.median_ms <= 0) {
    text.ours = to_text(cell.status == Status::ok ? Status::error : cell.status);
    return text;
  }
  text.ours = three(cell.fps()) + (cell.converged ? "" : "*");
  if (const auto ratio = ratio_of(cell))
    text.ratio = ratio->relation + (ratio->relation.empty() ? "" : " ") + three(ratio->value);
  return text;
}

std::vector<PaperTable> paper_tables(const std::vector<Cell>& cells, const ModelNote& note) {
  std::map<std::tuple<std::string, std::string, std::string, std::string, std::string>, std::vector<Cell>>
      groups;
  std::set<std::string> duels;  // rival_tables() shows these cells
  for (const Cell& c : cells)
    if (c.metrics.contains("opengl_ratio")) duels.insert(c.experiment);
  for (const Cell& c : cells)
    if (c.overrides.empty() && !duels.contains(c.experiment) && c.axes.contains("model") &&
        c.axes.contains("layers") && c.axes.contains("size") && !has_topology_axis(c) && !has_ways(cells, c))
      groups[{c.experiment, c.device, c.host, c.reading(), c.variant}].push_back(c);
  std::vector<PaperTable> tables;
  tables.reserve(groups.size());
  for (const auto& [key, group] : groups) tables.push_back(build(group, note));
  return tables;
}

std::string text_of(const PaperTable& table) {
  std::string text = fmt::format("{}{}{} on {}\n", table.experiment,
                                 table.reading == "default" ? "" : ", " + table.reading + " reading",
                                 table.variant == default_variant ? "" : ", " + table.variant, table.device);
  for (const PaperTable::Block& block : table.blocks) {
    text += fmt::format("\n{:<12}{:>10}", block.layers + " layers", "");
    for (const std::string& size : table.sizes) text += fmt::format("   {:^29}", size);
    text += fmt::format("\n{:<12}{:>10}", "model", "triangles");
    for (std::size_t i = 0; i < table.sizes.size(); ++i)
      text += fmt::format("   {:>11} {:>8} {:>8}", "ours", "paper", "ratio");
    text += "\n";
    for (const PaperTable::Row& row : block.rows) {
      text +=
          fmt::format("{:<12}{:>10}", row.model + (row.note.empty() ? "" : " " + row.note), row.triangles);
      for (const auto& cell : row.cells) {
        const CellText s = shown(cell);
        text += fmt::format("   {:>11} {:>8} {:>8}", s.ours, s.paper, s.ratio);
      }
      text += "\n";
    }
  }
  text +=
      "\nFrames per second: 1000 divided by the median wall time of a warm frame in ms.\n"
      "Ratio: ours divided by the paper's.\n";
  if (!table.hardware.empty())
    text +=
        fmt::format("The paper's frame rates are from {}, measured on {}.\n", table.source, table.hardware);
  if (any_unconverged(table)) text += "* the interval of the median is wider than the preset requires\n";
  for (const std::string& note : table.footnotes) text += note + "\n";
  return text;
}

std::string latex_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("&%$#_{}").find(c) != std::string_view::npos)
      result += std::string("\\") + c;
    else if (c == '\\')
      result += "\\textbackslash{}";
    else if (c == '~')
      result += "\\textasciitilde{}";
    else if (c == '^')
      result += "\\textasciicircum{}";
    else if (c == '<' || c == '>')
      result += fmt::format("${}$", c);
    else
      result += c;
  }
  return result;
}

std::string latex_of(const PaperTable& table) {
  std::string columns = "lr";
  for (std::size_t i = 0; i < table.sizes.size(); ++i) columns += "rrr";
  std::string text = "% needs \\usepackage{booktabs,threeparttable}\n\\begin{threeparttable}\n";
  text += fmt::format("\\begin{{tabular}}{{{}}}\n\\toprule\n", columns);
  for (const PaperTable::Block& block : table.blocks) {
    if (&block != &table.blocks.front()) text += "\\midrule\n";
    text += fmt::format("\\multicolumn{{2}}{{l}}{{{} layers}}", latex_text(block.layers));
    for (const std::string& size : table.sizes)
      text += fmt::format(" & \\multicolumn{{3}}{{c}}{{{}}}", [&] {
        const std::size_t x = size.find('x');
        return x == std::string::npos ? latex_text(size)
                                      : fmt::format("${} \\times {}$", size.substr(0, x), size.substr(x + 1));
      }());
    text += " \\\\\n";
    for (std::size_t i = 0; i < table.sizes.size(); ++i)
      text += fmt::format("\\cmidrule(lr){{{}-{}}} ", 3 + 3 * i, 5 + 3 * i);
    text += "\nModel & Triangles";
    for (std::size_t i = 0; i < table.sizes.size(); ++i) text += " & ours & paper & ratio";
    text += " \\\\\n\\midrule\n";
    for (const PaperTable::Row& row : block.rows) {
      text += latex_text(row.model);
      if (!row.note.empty()) text += fmt::format("\\tnote{{{}}}", row.note);
      text += " & " + row.triangles;
      for (const auto& cell : row.cells) {
        const CellText s = shown(cell);
        text += fmt::format(" & {} & {} & {}", latex_text(s.ours), latex_text(s.paper), latex_text(s.ratio));
      }
      text += " \\\\\n";
    }
  }
  text += "\\bottomrule\n\\end{tabular}\n\\begin{tablenotes}\\footnotesize\n";
  text += fmt::format("\\item Frames per second on {}; ratio: ours over the paper's{}.\n",
                      latex_text(table.device),
                      table.hardware.empty() ? "" : " (" + latex_text(table.hardware) + ")");
  if (any_unconverged(table))
    text += "\\item[*] The interval of the median is wider than the preset requires.\n";
  for (const std::string& note : table.footnotes)
    text += fmt::format("\\item[{}] {}\n", note.substr(0, 1), latex_text(note.substr(2)));
  return text + "\\end{tablenotes}\n\\end{threeparttable}\n";
}

std::string csv_of(const PaperTable& table) {
  std::string text = csv_line({"model",         "triangles",         "layers",         "size",
                               "reading",       "variant",           "device",         "status",
                               "ours_fps",      "ours_fps_low",      "ours_fps_high",  "median_ms",
                               "median_ms_low", "median_ms_high",    "samples",        "processes",
                               "converged",     "covered_fragments", "paper_relation", "paper_fps",
                               "paper_fps_low", "paper_fps_high",    "ratio",          "ratio_low",
                               "ratio_high"});
  auto number = [](const std::optional<double>& value) { return value ? fmt::format("{:.6g}", *value) : ""; };
  for (const PaperTable::Block& block : table.blocks)
    for (const PaperTable::Row& row : block.rows)
      for (std::size_t i = 0; i < row.cells.size(); ++i) {
        if (!row.cells[i]) continue;
        const Cell& c = *row.cells[i];
        const bool timed = c.median_ms > 0;
        auto of = [&](double value) { return timed ? fmt::format("{:.6g}", value) : ""; };
        std::size_t samples = 0;
        for (const auto& process : c.processes) samples += process.size();
        const Metric paper = c.paper_fps().value_or(Metric{});
        const Ratio ratio = ratio_of(c).value_or(Ratio{});
        const auto covered = c.metrics.find("covered_fragments");
        text += csv_line({row.model,
                          row.triangles,
                          block.layers,
                          table.sizes[i],
                          table.reading,
                          table.variant,
                          table.device,
                          std::string(to_text(c.status)),
                          of(c.fps()),
                          of(1000 / c.interval_ms.high),
                          of(1000 / c.interval_ms.low),
                          of(c.median_ms),
                          of(c.interval_ms.low),
                          of(c.interval_ms.high),
                          std::to_string(samples),
                          std::to_string(c.processes.size()),
                          c.converged ? "1" : "0",
                          covered == c.metrics.end() ? "" : fmt::format("{:.0f}", covered->second.value),
                          paper.relation,
                          paper.relation.empty() ? "" : fmt::format("{:g}", paper.value),
                          number(paper.low),
                          number(paper.high),
                          ratio.value > 0 ? ratio.relation + fmt::format("{:.6g}", ratio.value) : "",
                          number(ratio.low),
                          number(ratio.high)});
      }
  return text;
}

std::string file_stem_of(const PaperTable& table, bool several_devices) {
  std::string stem = table.experiment;
  if (table.reading != "default") stem += "-" + table.reading;
  if (table.variant != default_variant) stem += "-" + table.variant;
  if (several_devices) stem += "@" + table.device + "@" + table.host;
  std::string result;
  for (const char c : stem) result += c == '@' ? '-' : c;
  return file_name_of(result);
}

}  // namespace pelage
