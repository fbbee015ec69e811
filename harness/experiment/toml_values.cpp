#include "harness/experiment/toml_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>

#include "harness/base/toml_file.hpp"

namespace pelage {

namespace fs = std::filesystem;

std::string literal(const toml::node& node) {
  if (const auto number = node.value_exact<double>()) {
    const std::string digits = fmt::format("{}", *number);
    return digits.find_first_not_of("-0123456789") == std::string::npos ? digits + ".0" : digits;
  }
  // toml++'s formatter of arrays is not used. For numbers below 0.1, it converts a negative logarithm to an
  // unsigned integer, which is undefined behaviour.
  if (const auto* array = node.as_array()) {
    std::string text;
    for (const toml::node& entry : *array) text += (text.empty() ? "" : ", ") + literal(entry);
    return "[" + text + "]";
  }
  if (const auto* table = node.as_table()) {
    std::string text;
    for (const auto& [key, entry] : *table)
      text +=
          (text.empty() ? "" : ", ") + literal(toml::value(std::string(key.str()))) + " = " + literal(entry);
    return "{" + text + "}";
  }
  std::ostringstream text;
  node.visit([&text](const auto& value) {
    if constexpr (toml::is_value<decltype(value)>) text << value;
  });
  return text.str();
}

std::string plain(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  return literal(node);
}

std::string text_at(const fs::path& file, const toml::table& table, std::string_view key,
                    std::string_view table_name) {
  const toml::node* node = table.get(key);
  if (!node) return {};
  const auto text = node->value_exact<std::string>();
  if (!text) refuse(file, node, fmt::format("{}{} must be a string", table_name, key));
  return *text;
}

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

double number_at(const fs::path& file, const toml::table& table, std::string_view key, double otherwise,
                 double least, double most) {
  const toml::node* node = table.get(key);
  if (!node) return otherwise;
  const auto value = node->is_number() ? node->value<double>() : std::nullopt;
  if (!value || !(*value >= least && *value <= most))
    refuse(file, node, fmt::format("{} must be a number in [{}, {}]", key, least, most));
  return *value;
}

void check_keys(const fs::path& file, const toml::table& table, std::string_view table_name,
                const std::set<std::string_view>& known) {
  for (const auto& [key, node] : table)
    if (!known.contains(key.str()))
      refuse(file, &node,
             fmt::format("unknown key {}{} (known: {})", table_name, key.str(), fmt::join(known, ", ")));
}

}  // namespace pelage
