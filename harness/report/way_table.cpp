#include "harness/report/way_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "harness/report/csv.hpp"

namespace pelage {
namespace {

auto order(const WayTable::Column& c) {
  return std::tuple(c.model, std::atof(c.layers.c_str()), std::atof(c.size.c_str()), c.size);
}

bool timed(const std::optional<Cell>& cell) {
  return cell && cell->status == Status::ok && cell->median_ms > 0;
}

bool is_cell_of(const WayTable::Column& column, const Cell& c) {
  return column.model == c.axis("model") && column.layers == c.axis("layers") &&
         column.size == c.axis("size");
}

WayTable build(const std::vector<Cell>& cells) {
  WayTable table;
  table.experiment = cells.front().experiment;
  table.device = cells.front().device;
  table.host = cells.front().host;
  for (const Cell& c : cells)
    if (std::none_of(table.columns.begin(), table.columns.end(),
                     [&](const auto& column) { return is_cell_of(column, c); }))
      table.columns.push_back({c.axis("model"), c.axis("layers"), c.axis("size"), 0});
  std::sort(table.columns.begin(), table.columns.end(),
            [](const auto& a, const auto& b) { return order(a) < order(b); });
  for (const Cell& c : cells) {
    auto row = std::find_if(table.rows.begin(), table.rows.end(),
                            [&](const WayTable::Row& r) { return r.way == c.variant; });
    if (row == table.rows.end()) {
      table.rows.push_back({c.variant, 0, {}});
      row = table.rows.end() - 1;
      row->entries.resize(table.columns.size());
    }
    for (std::size_t k = 0; k < table.columns.size(); ++k)
      if (is_cell_of(table.columns[k], c)) row->entries[k] = c;
  }
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    for (const WayTable::Row& row : table.rows)
      if (double& fastest = table.columns[k].fastest_ms;
          timed(row.entries[k]) && (fastest == 0 || row.entries[k]->median_ms < fastest))
        fastest = row.entries[k]->median_ms;
  for (WayTable::Row& row : table.rows) {
    double sum = 0;
    int count = 0;
    for (std::size_t k = 0; k < table.columns.size(); ++k)
      if (timed(row.entries[k])) {
        sum += std::log(row.entries[k]->median_ms / table.columns[k].fastest_ms);
        ++count;
      }
    if (count > 0) row.times = std::exp(sum / count);
  }
  std::sort(table.rows.begin(), table.rows.end(), [](const auto& a, const auto& b) {
    return std::tuple(a.times == 0, a.times, a.way) < std::tuple(b.times == 0, b.times, b.way);
  });
  return table;
}

std::string head_of(const WayTable::Column& c) {
  return fmt::format("{}, {} layers, {}", c.model, c.layers, c.size);
}

std::string shown(const std::optional<Cell>& cell) {
  if (!cell) return "-";
  if (!timed(cell)) return std::string(to_text(cell->status));
  return fmt::format("{:.4g}{} [{:.4g}, {:.4g}]", cell->median_ms, cell->converged ? "" : "*",
                     cell->interval_ms.low, cell->interval_ms.high);
}

std::string times(double value) {
  return value > 0 ? fmt::format("{:.2f}", value) : "-";
}

constexpr const char* legend =
    "Frame time in ms: median and 95% interval (*: the interval is wider than the preset requires). "
    "Column times: frame time of the variant divided by the frame time of the fastest variant with a correct "
    "picture, geometric mean over the cases.";

}  // namespace

bool has_ways(const std::vector<Cell>& cells, const Cell& cell) {
  std::set<std::string> ways;
  for (const Cell& c : cells) {
    if (c.experiment != cell.experiment) continue;
    if (!c.axes.contains("model") || !c.axes.contains("layers") || !c.axes.contains("size") ||
        c.paper_fps() || c.metrics.contains("opengl_ratio") || c.axes.contains("dynamics.topology"))
      return false;
    ways.insert(c.variant);
  }
  return ways.size() >= fewest_ways;
}

std::vector<WayTable> way_tables(const std::vector<Cell>& cells) {
  std::map<std::tuple<std::string, std::string, std::string>, std::vector<Cell>> groups;
  for (const Cell& c : cells)
    if (c.overrides.empty() && has_ways(cells, c)) groups[{c.experiment, c.device, c.host}].push_back(c);
  std::vector<WayTable> tables;
  tables.reserve(groups.size());
  for (const auto& [key, group] : groups) tables.push_back(build(group));
  return tables;
}

std::string text_of(const WayTable& table) {
  std::string text = fmt::format("{} on {}\n\n{:<14}{:>7}", table.experiment, table.device, "way", "times");
  for (const WayTable::Column& column : table.columns) text += fmt::format("  {:>28}", head_of(column));
  text += "\n";
  for (const WayTable::Row& row : table.rows) {
    text += fmt::format("{:<14}{:>7}", row.way, times(row.times));
    for (const auto& entry : row.entries) text += fmt::format("  {:>28}", shown(entry));
    text += "\n";
  }
  return text + fmt::format("\n{}\n", legend);
}

std::string csv_of(const WayTable& table) {
  std::string text = csv_line({"way", "model", "layers", "size", "device", "status", "median_ms", "low_ms",
                               "high_ms", "by_fastest", "converged"});
  for (const WayTable::Row& row : table.rows)
    for (std::size_t k = 0; k < row.entries.size(); ++k) {
      if (!row.entries[k]) continue;
      const Cell& c = *row.entries[k];
      const auto of = [&](double v) { return timed(c) ? fmt::format("{:.6g}", v) : std::string(); };
      text += csv_line({row.way, c.axis("model"), c.axis("layers"), c.axis("size"), table.device,
                        std::string(to_text(c.status)), of(c.median_ms), of(c.interval_ms.low),
                        of(c.interval_ms.high), of(c.median_ms / table.columns[k].fastest_ms),
                        c.converged ? "1" : "0"});
    }
  return text;
}

std::string html_of(const WayTable& table) {
  std::string html = "<div class=\"wide\"><table>\n<thead><tr><th>Way</th><th>Times</th>";
  for (const WayTable::Column& column : table.columns) html += fmt::format("<th>{}</th>", head_of(column));
  html += "</tr></thead>\n<tbody>\n";
  for (const WayTable::Row& row : table.rows) {
    html += fmt::format("<tr><td>{}</td><td>{}</td>", row.way, times(row.times));
    for (const auto& entry : row.entries)
      html += fmt::format("<td class=\"{}\">{}</td>", timed(entry) ? "ours" : "bad", shown(entry));
    html += "</tr>\n";
  }
  return html + fmt::format("</tbody></table></div>\n<p class=\"soft\">{}</p>\n", legend);
}

}  // namespace pelage
