#include "harness/report/case_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "harness/base/numbers.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/record/device_settings.hpp"
#include "harness/scene/scene_keys.hpp"

namespace pelage {
namespace {

/// The columns of the axes are sorted by rank and then by name: first the model, then all other axes, then
/// the number of layers and the picture size.
std::pair<bool, bool> rank(const std::string& axis) {
  return {axis != "model", axis == "layers" || axis == "size"};
}

std::vector<std::string> axes_of(const std::vector<Cell>& cells) {
  std::set<std::string> names;
  for (const Cell& c : cells)
    for (const auto& [axis, value] : c.axes)
      if (axis != "variant") names.insert(axis);
  std::vector<std::string> sorted(names.begin(), names.end());
  std::ranges::stable_sort(sorted, {}, rank);
  return sorted;
}

Column axis_column(const std::string& axis) {
  if (axis == "layers") return {axis, axis, "{} layers"};
  if (axis == "compute_units") return {axis, "compute units", "compute units {}"};
  if (axis == "model" || axis == "size" || axis == "reading") return {axis, axis};
  // If the axis is a scene key with a list of choices, its values keep the order of this list.
  Column column{axis, axis, axis + " {}"};
  Scene scene;
  for (const Key& key : scene_keys(scene))
    if (key.name == axis && !key.choices.empty()) {
      column.order.assign(key.choices.begin(), key.choices.end());
      column.label = "{}";
    }
  return column;
}

/// Returns a column with a time or a frame rate. With `starred`, it adds marks_of() to the times, and shows
/// the status of cells without a time; without, it shows "-" for these cells, and for limits of an interval
/// from too few samples.
CellColumn time_column(const std::string& name, const std::string& heading, bool starred,
                       double (*number)(const Cell&)) {
  return {{name, heading}, [=](const Cell& c) {
            if (timed(c) && !starred && !has_interval(c)) return number_value({});
            if (!timed(c)) {
              const auto status = std::string(to_text(c.status == Status::ok ? Status::error : c.status));
              return Value{"", starred ? status : "-", c.reason, "", true};
            }
            Value value = number_value(number(c));
            if (!starred) return value;
            value.shown += marks_of(c);
            value.hint = fmt::format("{:.4g} ms", c.median_ms);
            if (has_interval(c))
              value.hint +=
                  fmt::format(", 95% interval {:.4g} to {:.4g} ms", c.interval_ms.low, c.interval_ms.high);
            return value;
          }};
}

void add_phases(std::vector<CellColumn>& columns, const std::vector<Cell>& cells) {
  std::set<std::string> phases;
  for (const Cell& c : cells)
    for (const auto& [phase, ms] : c.phase_ms) phases.insert(phase);
  for (const std::string& phase : phases)
    columns.push_back({{phase + "_ms", phase + ", ms"},
                       [phase](const Cell& c) { return number_value(found_in(c.phase_ms, phase)); }});
}

void add_metrics(std::vector<CellColumn>& columns, const std::vector<Cell>& cells) {
  std::map<std::string, std::string> units;  // metric -> unit
  std::set<std::string> with_interval, taken;
  for (const Cell& c : cells)
    for (const auto& [name, metric] : c.metrics) {
      if (name == "triangles")
        continue;  // case_columns() adds the column `triangles`, also for cells that failed
      units[name] = metric.unit;
      if (metric.low || metric.high) with_interval.insert(name);
    }
  for (const CellColumn& c : columns) taken.insert(c.column.name);
  for (const auto& [metric, unit] : units) {
    const auto add = [&, name = metric, unit = unit](const std::string& suffix,
                                                     std::optional<double> (*part)(const Metric&)) {
      const std::string own = name + suffix;
      const std::string column = taken.contains(own) ? "metric." + own : own;
      const std::string heading = unit.empty() || unit == name ? own : fmt::format("{}, {}", own, unit);
      columns.push_back({{column, heading}, [name, part](const Cell& c) {
                           const Metric* found = c.metric(name);
                           // The cell of a table that no run has measured (`pelage reproduce --preset
                           // smoke`).
                           if (c.status == Status::skipped) return Value{"", "skipped", c.reason, "", true};
                           if (c.status != Status::ok || !found) return number_value({});
                           const std::optional<double> number = part(*found);
                           if (found->unit == "dB" && number && *number >= decibels_of_equal_pictures)
                             return Value{"inf", "equal"};
                           return number && *number == double(std::int64_t(*number)) ? count_value(number)
                                                                                     : number_value(number);
                         }});
    };
    add("", [](const Metric& m) { return std::optional(m.value); });
    if (!with_interval.contains(metric)) continue;
    add("_low", [](const Metric& m) { return m.low; });
    add("_high", [](const Metric& m) { return m.high; });
  }
}

/// Returns for the path of each mesh file the name that tables show instead: the file name without folder and
/// extension, unless several paths have it in common.
std::map<std::string, std::string> short_model_names(const std::vector<Cell>& cells) {
  std::map<std::string, std::set<std::string>> paths;  // name -> paths
  for (const Cell& c : cells)
    if (const std::string model = c.axis("model"); !model.empty())
      paths[std::filesystem::path(model).stem().string()].insert(model);
  std::map<std::string, std::string> names;
  for (const auto& [name, all] : paths)
    if (all.size() == 1) names[*all.begin()] = name;
  return names;
}

/// Returns the number of triangles of each model of which a cell contains it.
std::map<std::string, double> triangles_by_model(const std::vector<Cell>& cells) {
  std::map<std::string, double> counts;
  for (const Cell& c : cells)
    if (const Metric* metric = c.metric("triangles"); metric && metric->value > 0) {
      double& count = counts[c.axis("model")];
      count = std::max(count, metric->value);
    }
  return counts;
}

/// If there are more than six texts, replaces those after the fifth by one text: "3 others".
void shorten(std::vector<std::string>& texts, std::string_view others) {
  constexpr std::size_t most = 5;
  if (texts.size() <= most + 1) return;
  std::string rest = fmt::format("{} {}", texts.size() - most, others);
  texts.resize(most);
  texts.push_back(std::move(rest));
}

/// Returns two or more names in parentheses, because they may contain commas: "(a), (b) and (c)", or "... and
/// 3 others".
std::string list_text(const std::set<std::string>& names) {
  std::vector<std::string> texts(names.size());
  std::ranges::transform(names, texts.begin(), [](const auto& name) { return fmt::format("({})", name); });
  shorten(texts, "others");
  const std::string last = std::move(texts.back());
  texts.pop_back();
  return fmt::format("{} and {}", fmt::join(texts, ", "), last);
}

}  // namespace

std::vector<CellColumn> case_columns(const std::vector<Cell>& cells) {
  std::vector<CellColumn> columns;
  const auto triangles = triangles_by_model(cells);
  const auto short_names = short_model_names(cells);
  for (const std::string& axis : axes_of(cells)) {
    columns.push_back({axis_column(axis), [axis, short_names](const Cell& c) {
                         Value value = text_value(c.axis(axis));
                         if (axis == "model")
                           value.shown = found_in(short_names, value.data).value_or(value.data);
                         return value;
                       }});
    if (axis == "model" && !triangles.empty())
      columns.push_back({{"triangles", "triangles"}, [triangles](const Cell& c) {
                           return count_value(found_in(triangles, c.axis("model")));
                         }});
  }
  const auto text = [&](const char* name, std::string (*of)(const Cell&)) {
    columns.push_back({{name, name}, [of](const Cell& c) { return text_value(of(c)); }});
  };
  text("variant", [](const Cell& c) { return c.variant; });
  text("experiment", [](const Cell& c) { return c.experiment; });
  text("device", [](const Cell& c) { return c.device; });
  text("host", [](const Cell& c) { return c.host; });
  text("changed", [](const Cell& c) { return changes_of(c.overrides); });
  text("status", [](const Cell& c) { return std::string(to_text(c.status)); });
  const auto time = [&](const char* name, const char* heading, bool starred, double (*of)(const Cell&)) {
    columns.push_back(time_column(name, heading, starred, of));
  };
  const std::string sample = sample_of(cells), heading = sample + ", ms";
  if (sample == "frame") {
    time("fps", "fps", true, [](const Cell& c) { return c.fps(); });
    time("fps_low", "low", false, [](const Cell& c) { return 1000 / c.interval_ms.high; });
    time("fps_high", "high", false, [](const Cell& c) { return 1000 / c.interval_ms.low; });
  }
  time("median_ms", heading.c_str(), true, [](const Cell& c) { return c.median_ms; });
  time("median_ms_low", "low", false, [](const Cell& c) { return c.interval_ms.low; });
  time("median_ms_high", "high", false, [](const Cell& c) { return c.interval_ms.high; });
  columns.push_back({{"cpu_ms", "CPU time, ms"},
                     [](const Cell& c) { return number_value(timed(c) ? c.cpu_ms : std::nullopt); }});
  text("samples", [](const Cell& c) {
    std::size_t count = 0;
    for (const auto& process : c.timings.processes) count += process.size();
    return std::to_string(count);
  });
  text("processes", [](const Cell& c) { return std::to_string(c.timings.processes.size()); });
  text("converged", [](const Cell& c) { return std::string(timed(c) && c.converged ? "1" : "0"); });
  columns.push_back({{"drift", "drift"}, [](const Cell& c) {
                       return number_value(timed(c) ? std::optional(c.drift) : std::nullopt);
                     }});
  text("contended", [](const Cell& c) { return std::string(c.contended || c.interrupted ? "1" : "0"); });
  add_phases(columns, cells);
  add_metrics(columns, cells);
  return columns;
}

Table table_of(const std::vector<Cell>& cells, const std::vector<CellColumn>& columns) {
  Table table;
  for (const CellColumn& c : columns) table.columns.push_back(c.column);
  for (const Cell& cell : cells) {
    std::vector<Value>& line = table.lines.emplace_back();
    for (const CellColumn& c : columns) {
      line.push_back(c.value(cell));
      line.back().cell = cell.index;
    }
  }
  return table;
}

bool has_column(const Table& table, std::string_view name) {
  return column_of(table, name) >= 0;
}

bool is_key(const std::string& column, const std::vector<Cell>& cells) {
  return column == "variant" ||
         std::any_of(cells.begin(), cells.end(), [&](const Cell& c) { return c.axes.contains(column); });
}

std::set<std::string> values_of(const Table& table, const std::string& column) {
  std::set<std::string> values;
  for (const auto& line : table.lines) values.insert(line[std::size_t(column_of(table, column))].data);
  return values;
}

std::vector<std::string> varying_keys(const Table& table, const std::vector<Cell>& cells) {
  std::vector<std::string> names;
  for (const Column& column : table.columns)
    if (is_key(column.name, cells) && values_of(table, column.name).size() > 1) names.push_back(column.name);
  return names;
}

void add_varying_keys(Table& table, const std::vector<Cell>& cells) {
  Layout& layout = table.layout;
  for (const std::string& name : varying_keys(table, cells)) {
    const auto has = [&](const auto& list) { return std::ranges::find(list, name) != list.end(); };
    if (!has(layout.blocks) && !has(layout.rows) && !has(layout.groups)) layout.rows.push_back(name);
  }
}

void show_interval(Table& table, const std::string& name) {
  if (!has_column(table, name + "_low") || !has_column(table, name + "_high")) return;
  for (auto& line : table.lines) {
    const auto value = [&](const char* end) -> Value& {
      return line[std::size_t(column_of(table, name + end))];
    };
    if (!value("_low").data.empty())
      value("").shown += fmt::format(" [{}, {}]", value("_low").shown, value("_high").shown);
  }
}

std::string subtitle_of(const std::vector<Cell>& cells, bool several_hosts) {
  const Cell& any = cells.front();
  const auto shared = [&](auto&& of) {
    return std::all_of(cells.begin(), cells.end(), [&](const Cell& c) { return of(c) == of(any); });
  };
  std::string text = fmt::format("{} on {}", any.experiment, any.device);
  if (several_hosts) text += ", host " + any.host;
  for (const std::string& axis : axes_of(cells)) {
    const std::string value = any.axis(axis);
    if (value.empty() || (axis == "reading" && is_usual_reading(value)) ||
        !shared([&](const Cell& c) { return c.axis(axis); }))
      continue;
    text += ", ";
    text += with_value(axis_column(axis), value);
  }
  if (any.variant != default_variant && shared([](const Cell& c) { return c.variant; }))
    text += ", variant " + any.variant;
  if (!any.overrides.empty()) text += "; changed: " + changes_of(any.overrides);
  return text;
}

void sort_cells(std::vector<Cell>& cells) {
  // Each sort keeps the order of the previous one among equal cells, so the most important criterion is last.
  std::ranges::stable_sort(cells, {}, &Cell::variant);
  std::vector<std::string> axes = axes_of(cells);
  std::reverse(axes.begin(), axes.end());
  for (const std::string& axis : axes)
    std::ranges::stable_sort(
        cells, [column = axis_column(axis)](const auto& a, const auto& b) { return precedes(column, a, b); },
        [&](const Cell& c) { return c.axis(axis); });
  auto triangles = triangles_by_model(cells);
  std::ranges::stable_sort(cells, {}, [&](const Cell& c) { return triangles[c.axis("model")]; });
}

std::string marks_of(const Cell& cell) {
  return std::string(cell.converged ? "" : "*") + (cell.contended || cell.interrupted ? "!" : "");
}

std::string interval_text(const Metric& ratio) {
  return ratio.low && ratio.high ? fmt::format(" [{:.2f}, {:.2f}]", *ratio.low, *ratio.high) : "";
}

std::string contended_remark() {
  return fmt::format(
      "! other processes used more than {:g}% of the machine's CPU time while the case was timed.",
      100 * most_other_share);
}

std::vector<std::string> mark_remarks(const std::vector<Cell>& cells) {
  const auto any = [&](bool (*marked)(const Cell&)) {
    return std::any_of(cells.begin(), cells.end(), [&](const Cell& c) { return timed(c) && marked(c); });
  };
  std::vector<std::string> remarks;
  if (any([](const Cell& c) { return !c.converged; }))
    remarks.emplace_back("* the 95% interval of the median is wider than the preset requires.");
  if (any([](const Cell& c) { return c.contended; })) remarks.push_back(contended_remark());
  if (any([](const Cell& c) { return c.interrupted; }))
    remarks.emplace_back(
        "! pelage was throttled by its cgroup, stopped, or asleep with the machine while the case was timed.");
  return remarks;
}

std::string name_of(const Cell& cell, const std::string& but) {
  std::vector<std::pair<std::string, std::string>> axes(cell.axes.begin(), cell.axes.end());
  std::ranges::stable_sort(axes, {}, [](const auto& axis) { return rank(axis.first); });
  std::string text;
  for (const auto& [axis, value] : axes) {
    if (axis == "variant" || axis == but || (axis == "reading" && is_usual_reading(value))) continue;
    text += text.empty() ? "" : ", ";
    // A word such as "sticks" names itself, but a number needs the name of its axis.
    text += number_of(value) ? with_value(axis_column(axis), value) : value;
  }
  return text.empty() ? cell.case_name : text;
}

std::string drift_remark(const std::vector<Cell>& cells) {
  constexpr std::size_t most = 5;
  std::vector<std::string> names;
  for (const Cell& c : cells)
    if (timed(c) && c.drift != 0) names.push_back(fmt::format("{} ({:+.1f}%)", name_of(c), 100 * c.drift));
  if (names.empty()) return {};
  std::string rest;
  if (names.size() > most) rest = fmt::format(" and {} other cases", names.size() - most);
  names.resize(std::min(names.size(), most));
  return fmt::format("Times drift during the run: {}{}.", fmt::join(names, ", "), rest);
}

std::string equal_pictures_remark(const std::vector<Cell>& cells) {
  std::vector<CasePicture> pictures;
  for (const Cell& c : cells) {
    if (!timed(c)) continue;
    Cell named;
    named.axes = c.axes;
    std::erase_if(named.axes, [](const auto& axis) { return is_device_setting(axis.first); });
    pictures.push_back({name_of(named), c.variant, fmt::format("{}", fmt::join(c.pixel_hashes, " "))});
  }
  return equal_pictures(pictures);
}

std::string equal_pictures(const std::vector<CasePicture>& pictures) {
  // A run measures its cases in random order, so the names are sorted.
  std::map<std::pair<std::string, std::string>, std::set<std::string>> names;  // hash and group -> names
  for (const CasePicture& one : pictures)
    if (!one.hash.empty()) names[{one.hash, one.group}].insert(one.name);
  std::multiset<std::set<std::string>> sets;
  for (const auto& [picture, equal] : names)
    if (equal.size() > 1) sets.insert(equal);
  if (sets.empty()) return {};
  std::vector<std::string> texts(sets.size());
  std::ranges::transform(sets, texts.begin(), list_text);
  shorten(texts, "other sets");
  return fmt::format("Equal pictures: {}. The settings in which these cases differ change no pixel.",
                     fmt::join(texts, "; "));
}

}  // namespace pelage
