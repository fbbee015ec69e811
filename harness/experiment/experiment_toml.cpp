// Reads experiment files (experiments/*.toml).
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <re2/re2.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "harness/base/numbers.hpp"
#include "harness/base/toml_table.hpp"
#include "harness/error.hpp"
#include "harness/experiment/axes.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

/// The path and the lines of an experiment file.
struct Source {
  fs::path file;
  std::vector<std::string> lines;
};

/// Top-level keys of experiment files. An axis must not have one of these names.
const std::set<std::string, std::less<>> reserved{"name",     "title",  "paper",   "table",     "collection",
                                                  "hardware", "axes",   "scene",   "published", "require",
                                                  "preset",   "report", "baseline"};

/// Columns of exported CSV files and data frames, in which each axis becomes a column too.
const std::set<std::string, std::less<>> columns{"case",       "clock",   "contended", "converged", "device",
                                                 "experiment", "high_ms", "host",      "identity",  "low_ms",
                                                 "median_ms",  "ms",      "phase",     "overrides", "reason",
                                                 "repeat",     "run_id",  "sample",    "samples",   "status"};

/// Returns a number as it is written in the file (0.10 stays 0.10), and plain() of other values.
std::string as_written(const toml::node& node, const Source& source) {
  const toml::source_region& at = node.source();
  if (!node.is_number()) return plain(node);
  const std::string written =
      source.lines.at(at.begin.line - 1).substr(at.begin.column - 1, at.end.column - at.begin.column);
  // toml++ counts columns in characters, but `lines` are indexed in bytes. If a character of several bytes
  // precedes the number in its line, `written` is therefore not the number. The following test detects this.
  const std::optional<double> number = double_of(written);
  return number && number == node.value<double>() ? written : plain(node);
}

/// Returns an axis value as text: as_written(), or for a list of numbers "[0.7, 1, 0]".
std::string axis_value(const Source& source, const std::string& axis, const toml::node& node) {
  if (node.is_value()) return as_written(node, source);
  const toml::array* list = node.as_array();
  if (!list || list->empty() || !is_scene_key(axis) ||
      !std::ranges::all_of(*list, [](const toml::node& one) { return one.is_number(); }))
    refuse(
        source.file, &node,
        fmt::format("the values of axis {} must be numbers or strings; only the axis of a scene key such as "
                    "camera.eye may have lists of numbers",
                    axis));
  std::vector<std::string> numbers;
  for (const toml::node& one : *list) numbers.push_back(as_written(one, source));
  return fmt::format("[{}]", fmt::join(numbers, ", "));
}

/// Appends the table's settings with dotted keys, so that [fur] length = 1 and fur.length = 1 give the same
/// setting, after checking them. Skips the keys for which `other` returns true.
void flatten(const fs::path& file, const toml::table& table, const std::string& prefix,
             bool (*other)(std::string_view), std::vector<Setting>& into) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (other(name)) continue;
    if (const auto* inner = node.as_table()) {
      flatten(file, *inner, name + ".", other, into);
      continue;
    }
    into.emplace_back(name, literal(node));
    Scene scratch;
    apply_set(scratch, fmt::format("{}={}", name, into.back().second),
              fmt::format("{}:{}", file.string(), node.source().begin.line));
  }
}

/// Adds the axes of `table` and of the tables in it, which come from dotted keys: TOML reads `curl.radius =
/// [1, 2]` as a table `curl` with the key `radius`.
void find_axes(const Source& source, const toml::table& table, const std::string& prefix,
               std::vector<std::pair<toml::source_position, Axis>>& found) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (const auto* inner = node.as_table()) {
      find_axes(source, *inner, name + ".", found);
      continue;
    }
    const auto* list = node.as_array();
    if (!list || list->empty())
      refuse(source.file, &node, fmt::format("axis {} must be a list of values", name));
    if (reserved.contains(name) || columns.contains(name))
      refuse(source.file, &node,
             fmt::format("an axis cannot have the name {0}, because {0} is {1}", name,
                         reserved.contains(name) ? "a key of experiment files" : "a column of CSV files"));
    Axis axis{name, {}};
    for (const toml::node& value : *list) axis.values.push_back(axis_value(source, name, value));
    std::set<std::string> different;
    for (const std::string& value : axis.values)
      if (!different.insert(canonical(value)).second)
        refuse(source.file, &node, fmt::format("axis {} contains the value {} twice", name, value));
    found.emplace_back(key.source().begin, std::move(axis));
  }
}

std::vector<Axis> read_axes(const Source& source, const toml::table& table) {
  std::vector<std::pair<toml::source_position, Axis>> found;
  find_axes(source, table, "", found);
  // toml++ sorts the keys of a table by name. This sort restores the order of the keys in the file from their
  // line and column numbers.
  std::ranges::sort(found, {}, [](const auto& one) { return std::pair(one.first.line, one.first.column); });
  std::vector<Axis> axes;
  axes.reserve(found.size());
  for (auto& [position, axis] : found) axes.push_back(std::move(axis));
  return axes;
}

Preset read_preset(const Source& source, std::string_view name, const toml::table& table) {
  TomlTable in(source.file, table, fmt::format("preset {}", name));
  Preset preset;
  SamplingLimits& limits = preset.limits;
  limits.warm_up_s = in.number("warm_up_s", limits.warm_up_s, 0, 3600);
  limits.least = int(in.whole("least", 1, 1'000'000).value_or(limits.least));
  limits.most = int(in.whole("most", 1, 1'000'000).value_or(limits.most));
  limits.precision = in.number("precision", limits.precision, 0, 1);
  limits.limit_s = in.number("limit_s", limits.limit_s, 0, 86400);
  if (limits.most < limits.least)
    in.refuse("most", "the value of 'most' must not be smaller than the value of 'least'");
  if (const toml::table* axes = in.table("axes")) preset.axes = read_axes(source, *axes);
  in.finish();
  return preset;
}

View read_view(const fs::path& file, const toml::table& table) {
  TomlTable in(file, table, "report");
  View view;
  for (const auto& [key, member] : view_lists) view.*member = in.texts(key);
  view.x = in.text("x");
  view.marks = in.text("marks");
  if (!view.marks.empty() && view.marks != "bars") in.refuse("marks", "marks must be \"bars\"");
  view.program = in.text("program");
  const std::vector<std::string> scale = in.texts("scale");
  for (const std::string& one : scale)
    if ((one != "linear" && one != "log") || scale.size() > 2)
      in.refuse("scale",
                "scale must be \"linear\" or \"log\", or a list of two of them, first for x, then for y");
  if (!scale.empty()) view.x_scale = scale.front(), view.y_scale = scale.back();
  in.finish();
  return view;
}

/// Returns the least values of metrics in a table. Tables in it are ignored.
std::map<std::string, double> least_values(const fs::path& file, const toml::table& table) {
  TomlTable in(file, table, "require");
  std::map<std::string, double> result;
  for (const auto& [metric, node] : table)
    if (!node.is_table()) result[std::string(metric.str())] = *in.number(metric.str());
  return result;
}

/// Reads the table [require]: least values of metrics for all cases, and tables [require.AXIS.VALUE] with
/// least values for the cases with this value of the axis.
void read_require(const fs::path& file, const toml::table& table, Experiment& into) {
  into.require = least_values(file, table);
  for (const auto& [axis, node] : table) {
    if (!node.is_table()) continue;
    for (const auto& [value, inner] : *node.as_table()) {
      if (!inner.is_table())
        refuse(file, &inner,
               fmt::format("require.{}.{} must be a table of metrics and least values", axis.str(),
                           value.str()));
      into.require_at[std::string(axis.str())][std::string(value.str())] =
          least_values(file, *inner.as_table());
    }
  }
}

/// Throws InputError if a table [require.AXIS.VALUE] names an axis or a value that the experiment does not
/// have. table: the whole file.
void check_require(const fs::path& file, const toml::table& table, const Experiment& experiment) {
  for (const auto& [axis, values] : experiment.require_at)
    for (const auto& [value, least] : values)
      if (!axis_values(experiment, axis).contains(value))
        refuse(file, table.get("require"),
               fmt::format("require.{}.{}: no axis has this name and value", axis, value));
}

std::vector<Published> read_published(const fs::path& file, const toml::table& table,
                                      const Experiment& experiment) {
  TomlTable in(file, table, "published");
  const std::string unit = in.text("unit");
  const std::vector<std::string> keys = in.texts("keys");
  const toml::node* cells = in.get("cells");
  in.finish();
  if (keys.empty() || !cells || !cells->is_array())
    refuse(file, &table, "[published] must have keys = [...] and cells = [[...], ...]");
  for (const std::string& key : keys)
    if (axis_values(experiment, key).empty()) in.refuse("keys", fmt::format("no axis has the name {}", key));
  std::vector<Published> result;
  for (const toml::node& node : *cells->as_array()) {
    const auto* cell = node.as_array();
    if (!cell || cell->size() != keys.size() + 1)
      refuse(
          file, &node,
          fmt::format(
              "each entry of cells must contain {} values (one per entry of keys) and then the published number",
              keys.size()));
    Published published;
    for (std::size_t i = 0; i < keys.size(); ++i) published.at[keys[i]] = plain((*cell)[i]);
    try {
      published.figure = published_figure(plain(cell->back()), unit);
    } catch (const InputError& error) {
      refuse(file, &node, error.what());
    }
    result.push_back(std::move(published));
  }
  return result;
}

/// True for the keys of a variant that select its implementation. All its other keys are scene keys.
bool says_how(std::string_view key) {
  return key == pipeline_key || key == mapping_key || key == opengl_key;
}

void read_tables_of_axis(const fs::path& file, const std::string& axis, const toml::table& table,
                         Experiment& into) {
  for (const auto& [value, node] : table) {
    const auto* settings = node.as_table();
    if (!settings) refuse(file, &node, fmt::format("{}.{} must be a table of scene keys", axis, value.str()));
    std::vector<Setting>& list = into.at[axis][std::string(value.str())];
    if (axis == "variant") {
      auto& how = into.variants[std::string(value.str())];
      for (const auto& [key, inner] : *settings)
        if (says_how(key.str())) how[std::string(key.str())] = plain(inner);
    }
    const auto none = [](std::string_view) { return false; };
    flatten(file, *settings, {}, axis == "variant" ? says_how : none, list);
  }
}

void read_scene_table(const fs::path& file, const toml::table& table, Experiment& into) {
  flatten(
      file, table, {}, [](std::string_view key) { return key == "file"; }, into.scene);
  const toml::node* node = table.get("file");
  if (!node) return;
  const auto name = node->value_exact<std::string>();
  if (!name || name->empty())
    refuse(file, node, "scene.file must be the path of a scene file, or the name of an example");
  try {
    into.base = read_scene(into.scene_file = file_or_example(file.parent_path(), *name));
  } catch (const InputError& error) {
    refuse(file, node, fmt::format("scene.file: {}", error.what()));
  }
}

/// Reads the tables of an axis whose name the author of the file chose. Throws InputError if no axis has this
/// name, or if a table's name is not among the axis's values while some value has no table: one of the names
/// is probably misspelled.
void read_tables_of_own_axis(const fs::path& file, const std::string& axis, const toml::node& node,
                             Experiment& into) {
  const std::set<std::string> values = axis_values(into, axis);
  if (values.empty())
    refuse(
        file, &node,
        fmt::format(
            "unknown key {} (known: axes, baseline, collection, hardware, layers, model, name, paper, preset, published, reading, require, scene, size, table, title, variant, and the names of axes; scene keys belong in the table [scene])",
            axis));
  if (!node.is_table()) refuse(file, &node, fmt::format("{} must be a table", axis));
  read_tables_of_axis(file, axis, *node.as_table(), into);
  const auto& tables = into.at[axis];
  for (const auto& [value, inner] : *node.as_table()) {
    if (values.contains(std::string(value.str()))) continue;
    for (const std::string& other : values)
      if (!tables.contains(other))
        refuse(
            file, &inner,
            fmt::format(
                "the axis {0} has no value {1}, and its value {2} has no table [{0}.{2}]: is one of the names misspelled?",
                axis, value.str(), other));
  }
}

}  // namespace

Metric published_figure(const std::string& text, const std::string& unit) {
  const std::string number = R"(([0-9]+(?:\.[0-9]+)?))";
  double value = 0, greatest = 0;
  if (RE2::FullMatch(text, number, &value)) {
    // A printed number represents all values that round to it. These values differ from the number by at
    // most half a unit of its last digit. For a whole number, half a unit is 0.5.
    const std::size_t point = text.find('.');
    const double half =
        point == std::string::npos ? 0.5 : 0.5 * std::pow(10.0, -double(text.size() - point - 1));
    return {value, unit, "=", value - half, value + half};
  }
  if (RE2::FullMatch(text, "< *" + number, &value)) return {value, unit, "<", std::nullopt, value};
  if (RE2::FullMatch(text, "~ *" + number, &value)) return {value, unit, "about", std::nullopt, std::nullopt};
  if (RE2::FullMatch(text, number + R"(\.\.)" + number, &value, &greatest) && value <= greatest)
    return {(value + greatest) / 2, unit, "range", value, greatest};
  throw InputError(
      fmt::format("'{}' is not a published figure; write for instance 267, < 1, ~ 30 or 20..30", text));
}

std::pair<std::string, View> read_view_of(const fs::path& file) {
  const toml::table table = read_toml(file);
  TomlTable in(file, table, "");
  const std::string name = in.required_text("name");
  const toml::table* report = in.table("report");
  if (!report) in.refuse("report", "there is no table [report]");
  return {name, read_view(file, *report)};
}

Experiment read_experiment(const fs::path& file) {
  const std::string text = toml_text_of(file);
  const toml::table table = parse_toml(text, file.string());
  Source source{file, {}};
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) source.lines.push_back(line);
  if (!table.contains("name") && !table.contains("axes"))
    throw InputError(fmt::format(
        "{}: is not an experiment, because it has neither a name nor axes. If it is a scene, write an experiment that takes it: [scene] file = \"{}\" (docs/extending.md)",
        file.string(), file.filename().string()));
  Experiment result;
  result.file = file;
  TomlTable in(file, table, "");
  result.name = in.text("name");
  result.title = in.text("title");
  result.paper = in.text("paper");
  result.table = in.text("table");
  result.hardware = in.text("hardware");
  result.collection = in.text("collection");
  result.baseline = in.texts("baseline");
  if (!RE2::FullMatch(result.name, "[A-Za-z0-9][A-Za-z0-9._-]*"))
    in.refuse("name",
              "name must begin with a letter or digit and consist of letters, digits, '.', '_' and '-'");
  static const std::set<std::string_view> texts{"name",     "title",      "paper",   "table",
                                                "hardware", "collection", "baseline"};
  static const std::set<std::string_view> tabled{"model", "layers", "size", "reading", "variant"};

  for (const auto& [key, node] : table) {
    if (texts.contains(key.str()) || key == "published") continue;
    if (!reserved.contains(key.str()) && !tabled.contains(key.str())) continue;  // read after this loop
    const auto* inner = node.as_table();
    if (!inner) refuse(file, &node, fmt::format("{} must be a table", key.str()));
    if (key == "scene") {
      read_scene_table(file, *inner, result);
    } else if (key == "axes") {
      result.axes = read_axes(source, *inner);
    } else if (key == "report") {
      result.view = read_view(file, *inner);
    } else if (key == "require") {
      read_require(file, *inner, result);
    } else if (key == "preset") {
      for (const auto& [name, preset] : *inner) {
        if (!preset.is_table()) refuse(file, &preset, fmt::format("preset.{} must be a table", name.str()));
        result.presets[std::string(name.str())] = read_preset(source, name.str(), *preset.as_table());
      }
    } else {
      read_tables_of_axis(file, std::string(key.str()), *inner, result);
    }
  }
  for (const std::string& name : result.baseline)
    if (std::ranges::none_of(result.axes, [&](const Axis& axis) { return axis.key == name; }))
      in.refuse("baseline", fmt::format("baseline: there is no axis {}", name));
  // These tables name axes, so they are read last: presets may add axes.
  if (const toml::table* published = in.table("published"))
    result.published = read_published(file, *published, result);
  for (const auto& [key, node] : table)
    if (!reserved.contains(key.str()) && !tabled.contains(key.str()))
      read_tables_of_own_axis(file, std::string(key.str()), node, result);
  check_require(file, table, result);
  if (result.axes.empty())
    refuse(file, nullptr, "there is no [axes] table; give it with at least model = [...]");
  if (result.presets.empty())
    refuse(file, nullptr, "there is no [preset.NAME]; the file must have at least [preset.quick]");
  return result;
}

}  // namespace pelage
