#include "harness/experiment/tables_toml.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "harness/error.hpp"

namespace pelage {

namespace fs = std::filesystem;

void refuse(const fs::path& file, const toml::node* node, const std::string& what) {
  const auto line = node ? node->source().begin.line : 0;
  throw InputError(line ? fmt::format("{}:{}: {}", file.string(), line, what)
                        : fmt::format("{}: {}", file.string(), what));
}

double number_at(const fs::path& file, const toml::table& table, std::string_view key, double otherwise,
                 double least, double most) {
  const toml::node* node = table.get(key);
  if (!node) return otherwise;
  const auto value = node->is_number() ? node->value<double>() : std::nullopt;
  if (!value || !(*value >= least && *value <= most))
    refuse(file, node, fmt::format("{} must be a number in [{}, {}]", key, least, most));
  return *value;
}

namespace {

/// Returns the strings at the key, which must be a list of strings or a single string. Returns an empty list
/// if the key is missing.
std::vector<std::string> texts_at(const fs::path& file, const toml::table& table, std::string_view key) {
  const toml::node* node = table.get(key);
  if (!node) return {};
  if (const auto text = node->value_exact<std::string>()) return {*text};
  const auto* list = node->as_array();
  if (!list || list->empty())
    refuse(file, node, fmt::format("report.{} must be a string or a list of strings", key));
  std::vector<std::string> texts;
  for (const toml::node& item : *list) {
    const auto text = item.value_exact<std::string>();
    if (!text) refuse(file, &item, fmt::format("report.{} must be a string or a list of strings", key));
    texts.push_back(*text);
  }
  return texts;
}

/// Returns the string at the key, or "" if the key is missing.
std::string one_text(const fs::path& file, const toml::table& table, std::string_view key) {
  const toml::node* node = table.get(key);
  if (!node) return {};
  const auto text = node->value_exact<std::string>();
  if (!text) refuse(file, node, fmt::format("report.{} must be a string", key));
  return *text;
}

/// Returns the least values of metrics in a table. Tables in it are ignored.
std::map<std::string, double> least_values(const fs::path& file, const toml::table& table) {
  std::map<std::string, double> result;
  for (const auto& [metric, node] : table)
    if (!node.is_table())
      result[std::string(metric.str())] = number_at(file, table, metric.str(), 0, -1e300, 1e300);
  return result;
}

}  // namespace

View view_from_toml(const fs::path& file, const toml::table& table) {
  static const std::set<std::string_view> known{"blocks", "columns", "panels", "program", "scale",
                                                "series", "values",  "x",      "y"};
  for (const auto& [key, node] : table)
    if (!known.contains(key.str()))
      refuse(file, &node,
             fmt::format("unknown key report.{} (known: {})", key.str(), fmt::join(known, ", ")));
  View view;
  view.blocks = texts_at(file, table, "blocks");
  view.columns = texts_at(file, table, "columns");
  view.values = texts_at(file, table, "values");
  view.x = one_text(file, table, "x");
  view.y = texts_at(file, table, "y");
  view.series = texts_at(file, table, "series");
  view.panels = texts_at(file, table, "panels");
  view.program = one_text(file, table, "program");
  const std::vector<std::string> scale = texts_at(file, table, "scale");
  for (const std::string& one : scale)
    if ((one != "linear" && one != "log") || scale.size() > 2)
      refuse(file, table.get("scale"),
             "report.scale must be \"linear\" or \"log\", or a list of two of them, first for x, then for y");
  if (!scale.empty()) view.x_scale = scale.front(), view.y_scale = scale.back();
  return view;
}

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

void check_require(const fs::path& file, const toml::table& table, const Experiment& experiment) {
  const auto known = [&](const std::string& axis, const std::string& value) {
    const auto has = [&](const std::vector<Axis>& axes) {
      return std::any_of(axes.begin(), axes.end(), [&](const Axis& one) {
        return one.key == axis && std::find(one.values.begin(), one.values.end(), value) != one.values.end();
      });
    };
    return has(experiment.axes) || std::any_of(experiment.presets.begin(), experiment.presets.end(),
                                               [&](const auto& preset) { return has(preset.second.axes); });
  };
  for (const auto& [axis, values] : experiment.require_at)
    for (const auto& [value, least] : values)
      if (!known(axis, value))
        refuse(file, table.get("require"),
               fmt::format("require.{}.{}: no axis has this name and value", axis, value));
}

}  // namespace pelage
