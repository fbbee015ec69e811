#include "harness/experiment/toml_values.hpp"

#include <fmt/format.h>

#include <sstream>

namespace pelage {

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

}  // namespace pelage
