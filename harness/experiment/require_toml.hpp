// Reads the table [require] of an experiment file: least values of metrics.
#pragma once
#include <toml++/toml.h>

#include <filesystem>

#include "harness/experiment/experiment.hpp"

namespace pelage {

/// Reads the table [require]: least values of metrics for all cases, and tables [require.AXIS.VALUE] with
/// least values for the cases with this value of the axis. Throws InputError for a value that is not a
/// number.
void read_require(const std::filesystem::path& file, const toml::table& table, Experiment& into);

/// Throws InputError if a table [require.AXIS.VALUE] names an axis or a value that the experiment does not
/// have. table: the whole file.
void check_require(const std::filesystem::path& file, const toml::table& table, const Experiment& experiment);

}  // namespace pelage
