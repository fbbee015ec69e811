// Reads values of the tables of an experiment file.
#pragma once
#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace pelage {

/// Throws InputError. The message names `file`, the line of `node` (unless it is null) and `what` is wrong.
[[noreturn]] void refuse(const std::filesystem::path& file, const toml::node* node, const std::string& what);

/// Returns the number `key` of a table, or `otherwise` if the table has no such key. Throws InputError if the
/// value is not a number in [least, most].
double number_at(const std::filesystem::path& file, const toml::table& table, std::string_view key,
                 double otherwise, double least, double most);

}  // namespace pelage
