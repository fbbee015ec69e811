// Reads the keys of a TOML table as values of the wanted types.
#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "harness/base/toml_file.hpp"

namespace pelage {

/// A TOML table. If a value has the wrong type, the functions throw InputError, whose message names the file,
/// the line and the table (unless `name` is empty). The constructor's arguments `file` and `table` must
/// outlive the object.
class TomlTable {
 public:
  using Texts = std::vector<std::string>;

  TomlTable(const std::filesystem::path& file, const toml::table& table, std::string name)
      : file_(file), table_(table), name_(std::move(name)) {}

  void rename(const std::string& name) { name_ = name; }
  bool has(std::string_view key) const { return table_.contains(key); }

  const toml::node* get(std::string_view key) {  ///< null if the key is absent
    known_.insert(std::string(key));
    return table_.get(key);
  }

  /// Throws InputError, whose message names the line of the key, or the line of the table if the key is
  /// absent.
  [[noreturn]] void refuse(std::string_view key, const std::string& what) const {
    const toml::node* node = table_.get(key);
    pelage::refuse(file_, node ? node : &table_, name_.empty() ? what : fmt::format("{}: {}", name_, what));
  }

  /// Returns the nested table; empty if the key is absent.
  std::optional<TomlTable> inner(std::string_view key) {
    const toml::table* found = table(key);
    if (!found) return {};
    return TomlTable(file_, *found, fmt::format("{}: {}", name_, key));
  }

  const toml::table* table(std::string_view key) {  ///< null if the key is absent
    const toml::node* node = get(key);
    if (node && !node->is_table()) refuse(key, fmt::format("{} must be a table: {{ key = value }}", key));
    return node ? node->as_table() : nullptr;
  }

  std::string text(std::string_view key) {  ///< "" if the key is absent
    const toml::node* node = get(key);
    if (!node) return {};
    const auto value = node->value_exact<std::string>();
    if (!value) refuse(key, fmt::format("{} must be a string", key));
    return *value;
  }

  std::string required_text(std::string_view key) {
    std::string value = text(key);
    if (value.empty()) refuse(key, fmt::format("{} = \"...\" is missing", key));
    return value;
  }

  Texts texts(std::string_view key) {  ///< strings; a single string becomes a list of one
    const toml::node* node = get(key);
    if (!node) return {};
    if (const auto value = node->value_exact<std::string>()) return {*value};
    const toml::array* array = node->as_array();
    if (!array || !array->is_homogeneous<std::string>())
      refuse(key, fmt::format("{} must be a string or a list of strings", key));
    Texts result;
    for (const toml::node& one : *array) result.push_back(*one.value<std::string>());
    return result;
  }

  std::optional<double> number(std::string_view key) {
    const toml::node* node = get(key);
    if (!node) return {};
    return finite(key, *node, "a finite number");
  }

  double number(std::string_view key, double otherwise, double least, double most) {
    const double value = number(key).value_or(otherwise);
    if (value < least || value > most)
      refuse(key, fmt::format("{} = {:g} is not between {:g} and {:g}", key, value, least, most));
    return value;
  }

  double required_number(std::string_view key, std::string_view why) {
    const auto value = number(key);
    if (!value) refuse(key, fmt::format("{} needs the number {}", why, key));
    return *value;
  }

  std::optional<std::int64_t> whole(std::string_view key, std::int64_t least, std::int64_t most) {
    const toml::node* node = get(key);
    if (!node) return {};
    const auto value = node->value_exact<std::int64_t>();
    if (!value || *value < least || *value > most)
      refuse(key, fmt::format("{} must be a whole number from {} to {}", key, least, most));
    return value;
  }

  std::vector<double> numbers(std::string_view key) {
    std::vector<double> result;
    const toml::node* node = get(key);
    if (!node) return result;
    if (!node->is_array()) refuse(key, fmt::format("{} must be a list of numbers", key));
    for (const toml::node& one : *node->as_array()) result.push_back(finite(key, one, "a list of numbers"));
    return result;
  }

  bool flag(std::string_view key) {  ///< false if the key is absent
    const toml::node* node = get(key);
    if (!node) return false;
    if (!node->is_boolean()) refuse(key, fmt::format("{} must be true or false", key));
    return node->value<bool>().value_or(false);
  }

  /// Returns an axis value: a string, or a whole number as text; "" if the key is absent. The axis values of
  /// claims and of rows are compared as text, and rows contain the text of the experiment file. A decimal
  /// number must therefore be a string with the same digits as in the experiment file.
  std::string axis_value(std::string_view key) {
    const toml::node* node = get(key);
    return node ? axis_value(key, *node) : std::string{};
  }

  Texts list(std::string_view key) {  ///< axis values; a single value becomes a list of one
    const toml::node* node = get(key);
    return node ? list(key, *node) : Texts{};
  }

  std::map<std::string, Texts> lists(std::string_view key) {  ///< axis -> values
    std::map<std::string, Texts> result;
    if (const toml::table* found = table(key)) add_lists(key, *found, "", result);
    return result;
  }

  std::map<std::string, std::string> values(std::string_view key) {  ///< key -> axis value
    std::map<std::string, std::string> result;
    if (const toml::table* found = table(key))
      for (const auto& [name, node] : *found) result[std::string(name.str())] = axis_value(key, node);
    return result;
  }

  /// Returns the index of the key's value in `names`, or `otherwise` if the key is absent.
  template <std::size_t N>
  std::size_t choice(std::string_view key, const std::array<std::string_view, N>& names,
                     std::size_t otherwise) {
    known_.insert(std::string(key));
    if (!has(key)) return otherwise;
    const std::string value = text(key);
    const auto found = std::find(names.begin(), names.end(), value);
    if (found == names.end())
      refuse(key, fmt::format("{} = \"{}\" is unknown (known: {})", key, value, fmt::join(names, ", ")));
    return std::size_t(found - names.begin());
  }

  /// Throws InputError if the table has a key that none of the functions above has read.
  void finish() const {
    for (const auto& [key, node] : table_)
      if (!known_.contains(std::string(key.str())))
        refuse(key.str(), fmt::format("the key {} is unknown or has no meaning here (known here: {})",
                                      key.str(), fmt::join(known_, ", ")));
  }

 private:
  double finite(std::string_view key, const toml::node& node, std::string_view wanted) const {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value)) refuse(key, fmt::format("{} must be {}", key, wanted));
    return *value;
  }

  std::string axis_value(std::string_view key, const toml::node& node) const {
    if (const auto value = node.value_exact<std::string>()) return *value;
    if (const auto value = node.value_exact<std::int64_t>()) return std::to_string(*value);
    refuse(
        key,
        fmt::format(
            "a value in {} is neither a string nor a whole number; write decimal numbers as strings, with the digits of the experiment file",
            key));
  }

  Texts list(std::string_view key, const toml::node& node) const {
    Texts result;
    if (const toml::array* array = node.as_array())
      for (const toml::node& one : *array) result.push_back(axis_value(key, one));
    else
      result.push_back(axis_value(key, node));
    if (result.empty()) refuse(key, fmt::format("a list in {} is empty", key));
    return result;
  }

  void add_lists(std::string_view key, const toml::table& from, const std::string& prefix,
                 std::map<std::string, Texts>& into) const {
    // TOML parses `dynamics.solver = ...` as a nested table `dynamics`. This function joins the nested
    // keys with dots, which gives the name of the axis, "dynamics.solver".
    for (const auto& [name, node] : from) {
      const std::string full = prefix + std::string(name.str());
      if (const toml::table* deeper = node.as_table())
        add_lists(key, *deeper, full + ".", into);
      else
        into[full] = list(key, node);
    }
  }

  const std::filesystem::path& file_;
  const toml::table& table_;
  std::string name_;
  std::set<std::string> known_;
};

}  // namespace pelage
