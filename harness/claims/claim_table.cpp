#include "harness/claims/claim_table.hpp"

#include <cmath>

#include "harness/error.hpp"

namespace pelage::claims {

const toml::node* Table::get(std::string_view key) {
  known_.insert(std::string(key));
  return table_.get(key);
}

const toml::table* Table::table(std::string_view key) {
  const toml::node* node = get(key);
  if (node && !node->is_table()) refuse(key, fmt::format("{} must be a table: {{ key = value }}", key));
  return node ? node->as_table() : nullptr;
}

bool Table::holds_text(std::string_view key) const {
  const toml::node* node = table_.get(key);
  return node && node->is_string();
}

void Table::refuse(std::string_view key, const std::string& what) const {
  const toml::node* node = table_.get(key);
  const auto line = node ? node->source().begin.line : table_.source().begin.line;
  throw InputError(fmt::format("{}:{}: {}: {}", file_.string(), line, name_, what));
}

std::optional<Table> Table::inner(std::string_view key) {
  const toml::table* found = table(key);
  if (!found) return {};
  return Table(file_, *found, fmt::format("{}: {}", name_, key));
}

std::string Table::text(std::string_view key) {
  const toml::node* node = get(key);
  if (!node) return {};
  const auto value = node->value_exact<std::string>();
  if (!value) refuse(key, fmt::format("{} must be a string", key));
  return *value;
}

std::string Table::required_text(std::string_view key) {
  std::string value = text(key);
  if (value.empty()) refuse(key, fmt::format("{} = \"...\" is missing", key));
  return value;
}

std::optional<double> Table::number(std::string_view key) {
  const toml::node* node = get(key);
  if (!node) return {};
  const auto value = node->is_number() ? node->value<double>() : std::nullopt;
  if (!value || !std::isfinite(*value)) refuse(key, fmt::format("{} must be a finite number", key));
  return value;
}

double Table::number(std::string_view key, double otherwise, double least, double most) {
  const double value = number(key).value_or(otherwise);
  if (value < least || value > most)
    refuse(key, fmt::format("{} = {:g} is not between {:g} and {:g}", key, value, least, most));
  return value;
}

double Table::required_number(std::string_view key, std::string_view why) {
  const auto value = number(key);
  if (!value) refuse(key, fmt::format("{} needs the number {}", why, key));
  return *value;
}

std::vector<double> Table::numbers(std::string_view key) {
  std::vector<double> result;
  const toml::node* node = get(key);
  if (!node) return result;
  if (!node->is_array()) refuse(key, fmt::format("{} must be a list of numbers", key));
  for (const toml::node& one : *node->as_array()) {
    const auto value = one.is_number() ? one.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value)) refuse(key, fmt::format("{} must be a list of numbers", key));
    result.push_back(*value);
  }
  return result;
}

bool Table::flag(std::string_view key) {
  const toml::node* node = get(key);
  if (!node) return false;
  if (!node->is_boolean()) refuse(key, fmt::format("{} must be true or false", key));
  return node->value<bool>().value_or(false);
}

std::string Table::axis_value(std::string_view key) {
  const toml::node* node = get(key);
  return node ? axis_value(key, *node) : std::string{};
}

std::string Table::axis_value(std::string_view key, const toml::node& node) const {
  if (const auto value = node.value_exact<std::string>()) return *value;
  if (const auto value = node.value_exact<std::int64_t>()) return std::to_string(*value);
  refuse(key, fmt::format("a value in {} is neither a string nor a whole number; write decimal numbers as "
                          "strings, with the digits of the experiment file",
                          key));
}

std::vector<std::string> Table::list(std::string_view key) {
  const toml::node* node = get(key);
  return node ? list(key, *node) : std::vector<std::string>{};
}

std::vector<std::string> Table::list(std::string_view key, const toml::node& node) const {
  std::vector<std::string> result;
  if (const toml::array* array = node.as_array())
    for (const toml::node& one : *array) result.push_back(axis_value(key, one));
  else
    result.push_back(axis_value(key, node));
  if (result.empty()) refuse(key, fmt::format("a list in {} is empty", key));
  return result;
}

std::map<std::string, std::vector<std::string>> Table::lists(std::string_view key) {
  std::map<std::string, std::vector<std::string>> result;
  if (const toml::table* found = table(key)) add_lists(key, *found, "", result);
  return result;
}

void Table::add_lists(std::string_view key, const toml::table& from, const std::string& prefix,
                      std::map<std::string, std::vector<std::string>>& into) const {
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

std::map<std::string, std::string> Table::values(std::string_view key) {
  std::map<std::string, std::string> result;
  if (const toml::table* found = table(key))
    for (const auto& [name, node] : *found) result[std::string(name.str())] = axis_value(key, node);
  return result;
}

void Table::finish() const {
  for (const auto& [key, node] : table_)
    if (!known_.contains(std::string(key.str())))
      refuse(key.str(), fmt::format("the key {} is unknown or has no meaning here (known here: {})",
                                    key.str(), fmt::join(known_, ", ")));
}

}  // namespace pelage::claims
