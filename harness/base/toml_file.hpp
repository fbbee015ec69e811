// Reads TOML, and writes values as TOML. The errors name the file and the line.
#pragma once
#include <fmt/format.h>
#include <toml++/toml.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "harness/error.hpp"
#include "harness/toml_text.hpp"

namespace pelage {

/// Throws InputError. The message names `file`, the line of `node` (unless it is null) and `what` is wrong.
[[noreturn]] inline void refuse(const std::filesystem::path& file, const toml::node* node,
                                const std::string& what) {
  const auto line = node ? node->source().begin.line : 0;
  throw InputError(line ? fmt::format("{}:{}: {}", file.string(), line, what)
                        : fmt::format("{}: {}", file.string(), what));
}

/// Parses a text after check_toml_text(). `name` is the file or the option that contains the text. Throws
/// InputError if the text is not TOML.
inline toml::table parse_toml(const std::string& text, const std::string& name) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw InputError(fmt::format("{}: UTF-16 text, which is not read; save the file as UTF-8", name));
  check_toml_text(text, name);
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}:{}: not TOML: {}", name, error.source().begin.line, error.description()));
  }
}

/// Returns the content of the file. Throws InputError if the file cannot be read.
inline std::string toml_text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw InputError(fmt::format("{}: cannot be read", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline toml::table read_toml(const std::filesystem::path& file) {
  return parse_toml(toml_text_of(file), file.string());
}

/// Returns the value as TOML text. Decimal numbers have as few digits as possible: 0.05, not
/// 0.050000000000000003.
inline std::string literal(const toml::node& node) {
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

/// Returns the text of a TOML value, without quotes if it is a string.
inline std::string plain(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  return literal(node);
}

}  // namespace pelage
