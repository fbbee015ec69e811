// Reads TOML. The errors name the file and the line.
#pragma once
#include <fmt/format.h>
#include <toml++/toml.h>

#include <filesystem>
#include <fstream>
#include <iterator>
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

}  // namespace pelage
