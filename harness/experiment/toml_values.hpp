// Typed values of the tables of experiment files. Errors name the file and the line.
#pragma once
#include <toml++/toml.h>

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace pelage {

/// Returns the value as TOML text. Decimal numbers have as few digits as possible: 0.05, not
/// 0.050000000000000003.
std::string literal(const toml::node& node);

/// Returns the text of a TOML value, without quotes if it is a string.
std::string plain(const toml::node& node);

/// Returns the string at the key, or "" if the key is missing. The error message has `table_name` before the
/// key.
std::string text_at(const std::filesystem::path& file, const toml::table& table, std::string_view key,
                    std::string_view table_name = "");

/// Returns the strings at the key of the table [report], which must be a list of strings or a single string.
/// Returns an empty list if the key is missing.
std::vector<std::string> texts_at(const std::filesystem::path& file, const toml::table& table,
                                  std::string_view key);

/// Returns the number `key` of a table, or `otherwise` if the table has no such key. Throws InputError if the
/// value is not a number in [least, most].
double number_at(const std::filesystem::path& file, const toml::table& table, std::string_view key,
                 double otherwise, double least, double most);

/// Throws InputError if the table has a key that is not in `known`.
void check_keys(const std::filesystem::path& file, const toml::table& table, std::string_view table_name,
                const std::set<std::string_view>& known);

}  // namespace pelage
