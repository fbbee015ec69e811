// Reads the tables [report] and [require] of an experiment file, and values of its other tables.
#pragma once
#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "harness/experiment/experiment.hpp"

namespace pelage {

/// Throws InputError. The message names `file`, the line of `node` (unless it is null) and `what` is wrong.
[[noreturn]] void refuse(const std::filesystem::path& file, const toml::node* node, const std::string& what);

/// Returns the number `key` of a table, or `otherwise` if the table has no such key. Throws InputError if the
/// value is not a number in [least, most].
double number_at(const std::filesystem::path& file, const toml::table& table, std::string_view key,
                 double otherwise, double least, double most);

/// Returns the view that the table describes. Throws InputError for an unknown key or a wrong value. The
/// message names `file`, the line and the permitted keys or values.
View view_from_toml(const std::filesystem::path& file, const toml::table& table);

/// Reads the table [require]: least values of metrics for all cases, and tables [require.AXIS.VALUE] with
/// least values for the cases with this value of the axis. Throws InputError for a value that is not a
/// number.
void read_require(const std::filesystem::path& file, const toml::table& table, Experiment& into);

/// Throws InputError if a table [require.AXIS.VALUE] names an axis or a value that the experiment does not
/// have. table: the whole file.
void check_require(const std::filesystem::path& file, const toml::table& table, const Experiment& experiment);

}  // namespace pelage
