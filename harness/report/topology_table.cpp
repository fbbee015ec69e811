#include "harness/report/topology_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "harness/report/csv.hpp"
#include "harness/report/paper_table.hpp"
#include "harness/scene/scene_keys.hpp"

namespace pelage {
namespace {

constexpr const char* axis = "dynamics.topology";

using Key = std::tuple<std::string, std::string, std::string, std::string>;  // experiment, device, host, case
using Phases = std::map<Key, std::map<std::string, std::vector<double>>>;

Phases event_times(const std::vector<FoundRow>& rows) {
  Phases all;
  for (const FoundRow& found : rows) {
    const Row& row = found.row;
    const std::string host = row.provenance.value("host", std::string());
    for (const auto& [phase, samples] : row.samples) {
      std::vector<double>& into = all[{row.experiment, row.device, host, row.case_name}][phase];
      into.insert(into.end(), samples.event_ms.begin(), samples.event_ms.end());
    }
  }
  return all;
}

std::optional<double> median_of(const std::map<std::string, std::vector<double>>& phases,
                                const std::string& phase) {
  const auto found = phases.find(phase);
  if (found == phases.end() || found->second.empty()) return {};
  return median(found->second);
}

auto order(const TopologyTable::Row& row) {
  return std::tuple(std::atof(row.layers.c_str()), std::atof(row.size.c_str()), row.size, row.triangles,
                    row.model);
}

bool timed(const std::optional<TopologyTable::Entry>& entry) {
  return entry && entry->cell.status == Status::ok && entry->cell.median_ms > 0;
}

void compare(TopologyTable& table) {
  table.summary.resize(table.topologies.size());
  for (std::size_t t = 0; t < table.topologies.size(); ++t) {
    TopologyTable::Summary& summary = table.summary[t];
    double logs = 0;
    std::vector<double> shares;
    std::size_t ratios = 0;
    for (TopologyTable::Row& row : table.rows) {
      std::optional<TopologyTable::Entry>& entry = row.entries[t];
      if (!timed(entry)) continue;
      if (timed(row.entries.front())) {
        entry->ratio = entry->cell.median_ms / row.entries.front()->cell.median_ms;
        logs += std::log(*entry->ratio);
        ++ratios;
      }
      if (!entry->simulate_ms) continue;
      shares.push_back(*entry->simulate_ms / entry->cell.median_ms);
      if (summary.worst && *summary.worst >= shares.back()) continue;
      summary.worst = shares.back();
      summary.worst_row = fmt::format("{}, {} layers, {}", row.model, row.layers, row.size);
    }
    if (ratios > 0) summary.ratio = std::exp(logs / double(ratios));
    if (!shares.empty()) summary.simulate = median(shares);
  }
}

TopologyTable build(const std::vector<Cell>& cells, const Phases& phases) {
  TopologyTable table{cells.front().experiment, cells.front().device, cells.front().host, {}, {}, {}};
  for (const std::string& topology : choices_of(axis))
    if (std::any_of(cells.begin(), cells.end(), [&](const Cell& c) { return c.axis(axis) == topology; }))
      table.topologies.push_back(topology);
  for (const Cell& c : cells) {
    const std::string model = c.axis("model"), layers = c.axis("layers"), size = c.axis("size");
    auto row = std::find_if(table.rows.begin(), table.rows.end(), [&](const TopologyTable::Row& r) {
      return r.model == model && r.layers == layers && r.size == size;
    });
    if (row == table.rows.end()) row = table.rows.insert(row, {model, layers, size, 0, {}});
    row->entries.resize(table.topologies.size());
    const auto topology = std::find(table.topologies.begin(), table.topologies.end(), c.axis(axis));
    if (topology == table.topologies.end()) continue;
    if (const auto found = c.metrics.find("triangles"); found != c.metrics.end())
      row->triangles = found->second.value;
    TopologyTable::Entry entry{c, {}, {}, {}};
    if (const auto found = phases.find({c.experiment, c.device, c.host, c.case_name});
        found != phases.end()) {
      entry.simulate_ms = median_of(found->second, "simulate");
      entry.raster_ms = median_of(found->second, "raster");
    }
    row->entries[std::size_t(topology - table.topologies.begin())] = std::move(entry);
  }
  std::sort(table.rows.begin(), table.rows.end(),
            [](const auto& a, const auto& b) { return order(a) < order(b); });
  compare(table);
  return table;
}

std::string three(std::optional<double> value) {
  return value ? fmt::format("{:.3g}", *value) : "-";
}

/// Returns the frame time and the simulation time as texts, in ms. If the cell has no time, returns the
/// status of its row and "-".
std::pair<std::string, std::string> shown(const std::optional<TopologyTable::Entry>& entry) {
  if (!entry) return {"-", "-"};
  if (!timed(entry)) return {std::string(to_text(entry->cell.status)), "-"};
  return {three(entry->cell.median_ms) + (entry->cell.converged ? "" : "*"), three(entry->simulate_ms)};
}

std::string percent(std::optional<double> share) {
  return share ? fmt::format("{:.2g}%", 100 * *share) : "-";
}

constexpr const char* legend =
    "Median wall time of a frame after warm-up, and median time of its simulation by the device's timer, ms.";

}  // namespace

bool has_topology_axis(const Cell& cell) {
  return cell.axes.contains(axis);
}

std::vector<TopologyTable> topology_tables(const std::vector<FoundRow>& rows) {
  std::map<std::tuple<std::string, std::string, std::string>, std::vector<Cell>> groups;
  for (const Cell& c : cells_of(rows))
    if (c.overrides.empty() && has_topology_axis(c) && c.axes.contains("model") &&
        c.axes.contains("layers") && c.axes.contains("size"))
      groups[{c.experiment, c.device, c.host}].push_back(c);
  const Phases phases = event_times(rows);
  std::vector<TopologyTable> tables;
  tables.reserve(groups.size());
  for (const auto& [key, cells] : groups) tables.push_back(build(cells, phases));
  return tables;
}

std::string text_of(const TopologyTable& table) {
  std::string text = fmt::format("{} on {}\n", table.experiment, table.device), block;
  for (const TopologyTable::Row& row : table.rows) {
    if (const std::string here = fmt::format("{} layers, {}", row.layers, row.size); here != block) {
      block = here;
      text += fmt::format("\n{:<24}{:>9}", block, "");
      for (const std::string& t : table.topologies) text += fmt::format("  {:^17}", t);
      text += fmt::format("\n{:<24}{:>9}", "model", "triangles");
      for (std::size_t i = 0; i < table.topologies.size(); ++i)
        text += fmt::format("  {:>8} {:>8}", "frame", "simulate");
      text += "\n";
    }
    text += fmt::format("{:<24}{:>9.0f}", row.model, row.triangles);
    for (const auto& entry : row.entries) {
      const auto [frame, simulate] = shown(entry);
      text += fmt::format("  {:>8} {:>8}", frame, simulate);
    }
    text += "\n";
  }
  text += fmt::format("\n{:<33}", "frame, times " + (table.topologies.empty() ? "" : table.topologies[0]));
  for (const auto& s : table.summary) text += fmt::format("  {:>17}", three(s.ratio));
  text += fmt::format("\n{:<33}", "simulation's share, median");
  for (const auto& s : table.summary) text += fmt::format("  {:>17}", percent(s.simulate));
  text += fmt::format("\n{:<33}", "simulation's share, most");
  for (const auto& s : table.summary) text += fmt::format("  {:>17}", percent(s.worst));
  return text + "\n\n" + legend + " Times: geometric mean over the rows.\n";
}

std::string csv_of(const TopologyTable& table) {
  std::string text = csv_line({"model", "triangles", "layers", "size", "topology", "masses", "springs",
                               "device", "status", "median_ms", "median_ms_low", "median_ms_high",
                               "simulate_ms", "raster_ms", "ratio", "converged"});
  const auto number = [](std::optional<double> v) { return v ? fmt::format("{:.6g}", *v) : std::string(); };
  for (const TopologyTable::Row& row : table.rows)
    for (std::size_t t = 0; t < row.entries.size(); ++t) {
      if (!row.entries[t]) continue;
      const TopologyTable::Entry& e = *row.entries[t];
      const bool ok = timed(row.entries[t]);
      const auto metric = [&](const char* name) {
        const auto found = e.cell.metrics.find(name);
        return found == e.cell.metrics.end() ? std::string() : fmt::format("{:.0f}", found->second.value);
      };
      const auto of = [&](double value) { return ok ? fmt::format("{:.6g}", value) : std::string(); };
      text += csv_line({row.model, fmt::format("{:.0f}", row.triangles), row.layers, row.size,
                        table.topologies[t], metric("masses"), metric("springs"), table.device,
                        std::string(to_text(e.cell.status)), of(e.cell.median_ms), of(e.cell.interval_ms.low),
                        of(e.cell.interval_ms.high), number(e.simulate_ms), number(e.raster_ms),
                        number(e.ratio), e.cell.converged ? "1" : "0"});
    }
  return text;
}

std::string latex_of(const TopologyTable& table) {
  std::string columns = "lrrl", head = "Model & Triangles & Layers & Size";
  for (const std::string& t : table.topologies) {
    columns += "rr";
    head += fmt::format(" & \\multicolumn{{2}}{{c}}{{{}}}", latex_text(t));
  }
  std::string text = fmt::format(
      "% needs \\usepackage{{booktabs}}; {}\n\\begin{{tabular}}{{{}}}\n\\toprule\n{} \\\\\n\\midrule\n",
      legend, columns, head);
  for (const TopologyTable::Row& row : table.rows) {
    text += fmt::format("{} & {:.0f} & {} & {}", latex_text(row.model), row.triangles, row.layers, row.size);
    for (const auto& entry : row.entries) {
      const auto [frame, simulate] = shown(entry);
      text += fmt::format(" & {} & {}", latex_text(frame), latex_text(simulate));
    }
    text += " \\\\\n";
  }
  return text + "\\bottomrule\n\\end{tabular}\n";
}

std::string html_of(const TopologyTable& table) {
  std::string html =
      "<div class=\"wide\"><table>\n<thead><tr><th>Model</th><th>Triangles</th><th>Layers</th><th>Size</th>";
  for (const std::string& t : table.topologies)
    html += fmt::format("<th class=\"group\" colspan=\"2\">{}</th>", t);
  html += "</tr></thead>\n<tbody>\n";
  for (const TopologyTable::Row& row : table.rows) {
    html += fmt::format("<tr><td>{}</td><td>{:.0f}</td><td>{}</td><td>{}</td>", row.model, row.triangles,
                        row.layers, row.size);
    for (const auto& entry : row.entries) {
      const auto [frame, simulate] = shown(entry);
      html +=
          fmt::format("<td class=\"{}\">{}</td><td>{}</td>", timed(entry) ? "ours" : "bad", frame, simulate);
    }
    html += "</tr>\n";
  }
  html += "<tr><td>frame, times the first</td><td></td><td></td><td></td>";
  for (const auto& s : table.summary) html += fmt::format("<td>{}</td><td></td>", three(s.ratio));
  html += "</tr>\n<tr><td>simulation's share, median (most)</td><td></td><td></td><td></td>";
  for (const auto& s : table.summary)
    html += fmt::format("<td>{}</td><td title=\"{}\">({})</td>", percent(s.simulate), s.worst_row,
                        percent(s.worst));
  return html + fmt::format("</tr>\n</tbody></table></div>\n<p class=\"soft\">{}</p>\n", legend);
}

}  // namespace pelage
