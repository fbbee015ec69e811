// Reads the keys of a TOML table in a file of claims. An axis is a parameter that varies over the cases of an
// experiment.
#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace pelage::claims {

/// A TOML table. If a value has the wrong type, the functions throw InputError, whose message names the file,
/// the line and the table. The constructor's arguments `file` and `table` must outlive the object.
class Table {
 public:
  Table(const std::filesystem::path& file, const toml::table& table, std::string name)
      : file_(file), table_(table), name_(std::move(name)) {}

  void rename(const std::string& name) { name_ = name; }
  bool has(std::string_view key) const { return table_.contains(key); }
  bool holds_text(std::string_view key) const;

  /// Throws InputError, whose message names the line of the key, or the line of the table if the key is
  /// absent.
  [[noreturn]] void refuse(std::string_view key, const std::string& what) const;

  std::optional<Table> inner(std::string_view key);  ///< the nested table; empty if the key is absent
  std::string text(std::string_view key);            ///< "" if the key is absent
  std::string required_text(std::string_view key);
  std::optional<double> number(std::string_view key);  ///< a finite number
  double number(std::string_view key, double otherwise, double least, double most);
  double required_number(std::string_view key, std::string_view why);
  std::vector<double> numbers(std::string_view key);
  bool flag(std::string_view key);  ///< false if the key is absent

  /// Returns an axis value: a string, or a whole number as text. The axis values of claims and of
  /// rows are compared as text, and rows contain the text of the experiment file. A decimal number must
  /// therefore be a string with the same digits as in the experiment file.
  std::string axis_value(std::string_view key);
  std::vector<std::string> list(std::string_view key);  ///< axis values; a single value becomes a list of one
  std::map<std::string, std::vector<std::string>> lists(std::string_view key);  ///< axis -> values
  std::map<std::string, std::string> values(std::string_view key);              ///< key -> axis value

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
  void finish() const;

 private:
  const toml::node* get(std::string_view key);
  const toml::table* table(std::string_view key);
  std::string axis_value(std::string_view key, const toml::node& node) const;
  std::vector<std::string> list(std::string_view key, const toml::node& node) const;
  void add_lists(std::string_view key, const toml::table& from, const std::string& prefix,
                 std::map<std::string, std::vector<std::string>>& into) const;

  const std::filesystem::path& file_;
  const toml::table& table_;
  std::string name_;
  std::set<std::string> known_;
};

}  // namespace pelage::claims
