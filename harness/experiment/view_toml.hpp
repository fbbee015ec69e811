// Reads the table [report] of an experiment file.
#pragma once
#include <toml++/toml.h>

#include <filesystem>

#include "harness/experiment/view.hpp"

namespace pelage {

/// Returns the view that the table describes. Throws InputError for an unknown key or a wrong value; the
/// message names `file`, the line and what is permitted.
View view_from_toml(const std::filesystem::path& file, const toml::table& table);

}  // namespace pelage
