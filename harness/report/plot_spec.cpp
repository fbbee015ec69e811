#include "harness/report/plot_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "harness/base/numbers.hpp"
#include "harness/data_folder.hpp"
#include "harness/error.hpp"
#include "harness/isolated/isolated.hpp"
#include "harness/measure/provenance.hpp"
#include "harness/nearest_name.hpp"
#include "harness/record/device_settings.hpp"
#include "harness/report/answer.hpp"
#include "harness/report/case_table.hpp"

namespace pelage {
namespace {

using Names = std::vector<std::string>;

bool is_numeric(const Table& table, const std::string& column) {
  return std::ranges::all_of(values_of(table, column),
                             [](const std::string& v) { return v.empty() || number_of(v); });
}

/// A plot has at most seven series, because readers can distinguish only about seven colours. It has at most
/// 12 panels.
constexpr std::size_t most_series = 7, most_panels = 12;

/// Returns the number of combinations of these columns' values.
std::size_t combinations(const Table& table, const Names& columns) {
  std::set<Names> found;
  for (const auto& line : table.lines) {
    Names values;
    for (const std::string& column : columns)
      values.push_back(line[std::size_t(column_of(table, column))].data);
    found.insert(std::move(values));
  }
  return found.size();
}

/// Removes the column with the most values from `names` and returns it; "" if there is none.
std::string take_largest(const Table& table, Names& names) {
  const auto most =
      std::ranges::max_element(names, {}, [&](const auto& name) { return values_of(table, name).size(); });
  if (most == names.end()) return {};
  std::string name = *most;
  names.erase(most);
  return name;
}

std::string scale_of(const Table& table, const std::string& column) {
  std::vector<double> numbers;
  for (const std::string& text : values_of(table, column))
    if (!text.empty()) numbers.push_back(number_of(text).value_or(0));
  if (numbers.empty()) return "linear";
  const auto [least, most] = std::ranges::minmax(numbers);
  return least > 0 && most >= 20 * least ? "log" : "linear";
}

std::string suggestion(const Table& table, const std::string& name) {
  std::vector<std::string> columns;
  for (const Column& column : table.columns) columns.push_back(column.name);
  const std::string near = nearest_name(name, columns);
  return near.empty() ? "" : fmt::format(" (did you mean {}?)", near);
}

/// Returns those of `names` that are columns of the table. Adds a note for every other name.
Names known(const Table& table, const Names& names, const char* key, std::vector<std::string>& notes) {
  Names result;
  for (const std::string& name : names)
    if (has_column(table, name))
      result.push_back(name);
    else
      notes.push_back(fmt::format(
          "{}: {} names \"{}\", but tables/{}.csv has no such column{}; correct the table [report] of the experiment file and give the file with --view",
          table.subtitle, key, name, table.stem, suggestion(table, name)));
  return result;
}

void erase_from(Names& names, const Names& taken) {
  std::erase_if(names, [&](const auto& n) { return std::ranges::find(taken, n) != taken.end(); });
}

/// Sets x, series and panels of the plot as plots_of() says.
void place(PlotSpec& plot, const Table& table, const std::vector<Cell>& cells, const View& view,
           std::vector<std::string>& notes) {
  Names keys = varying_keys(table, cells);
  plot.series = known(table, view.series, "series", notes);
  plot.panels = known(table, view.panels, "panels", notes);
  erase_from(keys, plot.series);
  erase_from(keys, plot.panels);
  if (const Names x = known(table, view.x.empty() ? Names{} : Names{view.x}, "x", notes); !x.empty()) {
    plot.x = x.front();
    // Each model has one number of triangles, so the model needs no series of its own.
    if (plot.x == "triangles") erase_from(keys, {"model"});
    erase_from(keys, x);
    // If x had a single value, all points of the plot would lie on one vertical line and cover each other.
    if (values_of(table, plot.x).size() < 2) {
      Names& names = combinations(table, plot.series) > 1 ? plot.series : keys;
      if (std::string other = take_largest(table, names); !other.empty()) plot.x = std::move(other);
    }
  } else {
    Names numeric, words;
    // The settings of a device are lines beside each other, as names are.
    for (const std::string& key : keys)
      (is_numeric(table, key) && !is_device_setting(key) ? numeric : words).push_back(key);
    Names rest = numeric;
    plot.x = take_largest(table, rest);
    // If x has fewer than three values, each series has at most two points. Many such short series are hard
    // to read.
    const bool poor =
        !plot.x.empty() && values_of(table, plot.x).size() < 3 && combinations(table, words) > most_series;
    if (plot.x.empty() || poor) {
      rest = numeric;
      plot.x = take_largest(table, words);
    } else if (plot.panels.empty() && !rest.empty()) {
      plot.panels = {take_largest(table, rest)};
    }
    if (plot.x.empty()) plot.x = has_column(table, "model") ? "model" : "variant";
    keys = words;
    keys.insert(keys.end(), rest.begin(), rest.end());
    // Too many series make a plot unreadable. If there are too many, the keys with the fewest values define
    // panels instead of series.
    while (view.panels.empty() && view.series.empty() && keys.size() > 1 &&
           combinations(table, keys) > most_series) {
      const auto fewest =
          std::ranges::min_element(keys, {}, [&](const auto& key) { return values_of(table, key).size(); });
      Names more = plot.panels;
      more.push_back(*fewest);
      if (combinations(table, more) > most_panels) break;
      plot.panels = more;
      keys.erase(fewest);
    }
  }
  // If x is a measured number, the remaining keys (such as the time step) define no series. One line then
  // joins the cases that differ only in these keys.
  const bool measured = plot.x != "triangles" && !is_key(plot.x, cells);
  if (!measured || plot.series.empty()) plot.series.insert(plot.series.end(), keys.begin(), keys.end());
}

}  // namespace

std::vector<PlotSpec> plots_of(const Table& table, const std::vector<Cell>& cells, const View& view,
                               std::vector<std::string>& notes) {
  // The numbers of a paper's figures are no quantity, and their frames were drawn for the pictures.
  const auto of_a_figure = [](const Cell& c) { return c.axes.contains("figure"); };
  if (view == View{} && std::ranges::any_of(cells, of_a_figure)) return {};
  PlotSpec first;
  place(first, table, cells, view, notes);
  first.bars = view.marks == "bars";
  first.note = cells.empty() ? "" : cells.front().device;
  for (const Column& column : table.columns) {
    if (!column.order.empty()) first.order[column.name] = column.order;
    if (column.label != "{}") first.labels[column.name] = column.label;
  }
  const auto heading = [&](const std::string& name) {
    return table.columns[std::size_t(column_of(table, name))].heading;
  };
  first.x_label = first.x == "size" ? "pixels" : heading(first.x);
  first.x_scale = view.x_scale.empty() ? scale_of(table, first.x) : view.x_scale;
  std::vector<PlotSpec> plots;
  for (const std::string& y : known(table, view.y.empty() ? Names{"median_ms"} : view.y, "y", notes)) {
    const auto numbers = std::count_if(table.lines.begin(), table.lines.end(), [&](const auto& line) {
      return number_of(line[std::size_t(column_of(table, y))].data).has_value();
    });
    if (numbers < 2) continue;
    PlotSpec plot = first;
    plot.y = y;
    const std::string sample = sample_of(cells);
    plot.y_label = y != "median_ms" ? heading(y) : sample == "frame" ? "frame time, ms" : sample + ", ms";
    if (const std::string words = words_of(y, cells); !words.empty()) plot.y_label = words;
    if (y.ends_with("_ms") && !plot.y_label.ends_with(", ms")) plot.y_label += ", ms";
    plot.y_scale = view.y_scale.empty() ? scale_of(table, y) : view.y_scale;
    if (y == "frame_over_baseline") plot.y_label = "frame time / frame time of the baseline", plot.guide = 1;
    if (std::ranges::count(qualities_of(cells), y) > 0) plot.limits = told_limits(y);
    if (plot.y_label.ends_with(", dB")) plot.y_scale = "linear";  // decibels are logarithms already
    if (has_column(table, y + "_low")) plot.low = y + "_low", plot.high = y + "_high";
    plot.title = fmt::format("{} against {}: {}", plot.y_label, plot.x_label, table.subtitle);
    plot.stem = fmt::format("{}-{}", table.stem, y == "median_ms" ? "frame-time" : file_name_of(y));
    plots.push_back(std::move(plot));
  }
  return plots;
}

std::string json_of(const PlotSpec& plot) {
  nlohmann::ordered_json json{{"title", plot.title},     {"note", plot.note},       {"x", plot.x},
                              {"x_label", plot.x_label}, {"x_scale", plot.x_scale}, {"y", plot.y},
                              {"y_label", plot.y_label}, {"y_scale", plot.y_scale}, {"low", plot.low},
                              {"high", plot.high},       {"series", plot.series},   {"panels", plot.panels},
                              {"order", plot.order},     {"labels", plot.labels}};
  if (!plot.published.empty())
    json["published"] = {{"column", plot.published}, {"label", plot.published_label}};
  if (plot.bars) json["bars"] = true;
  if (plot.guide) json["guide"] = *plot.guide;
  if (!plot.limits.empty()) json["limits"] = plot.limits;
  return json.dump(2) + "\n";
}

namespace fs = std::filesystem;

fs::path plot_program(const std::string& name) {
  for (const fs::path& data : data_folders(PELAGE_SOURCE_DIR, PELAGE_SHARE_DIR))
    // The first folder is that of an installation, and the second folder is that of the source tree.
    for (const char* folder : {"plots", "harness/report/plots"})
      if (const fs::path file = data / folder / (name + ".py"); fs::is_regular_file(file)) return file;
  throw InputError(fmt::format("plots/{}.py is missing; set PELAGE_DATA to pelage's data folder", name));
}

std::string draw_plot(const fs::path& program, const fs::path& table, const fs::path& stem) {
  const std::string python = fs::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
  const ProgramOutcome outcome = run_program(
      {python, "-B", program.string(), table.string(), stem.string() + ".svg", stem.string() + ".pdf"});
  if (outcome.code == 0) return {};
  if (outcome.code == 127) return "no plots: python3 is not installed";
  if (outcome.messages.find("No module named 'matplotlib'") != std::string::npos)
    return "no plots: matplotlib is not installed (Debian: python3-matplotlib)";
  return fmt::format("no plots: {}: {}", program.filename().string(), last_line(outcome.messages));
}

}  // namespace pelage
