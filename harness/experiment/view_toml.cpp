#include "harness/experiment/view_toml.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>
#include <string_view>

#include "harness/experiment/toml_values.hpp"
#include "harness/record/ratios.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

/// Returns the strings at the key, which must be a list of strings or a single string. Returns an empty list
/// if the key is missing.
std::vector<std::string> texts_at(const fs::path& file, const toml::table& table, std::string_view key) {
  const toml::node* node = table.get(key);
  if (!node) return {};
  if (const auto text = node->value_exact<std::string>()) return {present_metric(*text, file.string())};
  const auto* list = node->as_array();
  if (!list || list->empty())
    refuse(file, node, fmt::format("report.{} must be a string or a list of strings", key));
  std::vector<std::string> texts;
  for (const toml::node& item : *list) {
    const auto text = item.value_exact<std::string>();
    if (!text) refuse(file, &item, fmt::format("report.{} must be a string or a list of strings", key));
    texts.push_back(present_metric(*text, file.string()));
  }
  return texts;
}

/// Returns the string at the key, or "" if the key is missing.
std::string one_text(const fs::path& file, const toml::table& table, std::string_view key) {
  const toml::node* node = table.get(key);
  if (!node) return {};
  const auto text = node->value_exact<std::string>();
  if (!text) refuse(file, node, fmt::format("report.{} must be a string", key));
  return present_metric(*text, file.string());
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

}  // namespace pelage
