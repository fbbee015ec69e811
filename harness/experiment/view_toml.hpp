// Reads the table [report] of an experiment file.
#pragma once
#include <toml++/toml.h>

#include <filesystem>

#include "harness/experiment/view.hpp"

namespace pelage {

/// Returns the view that the table describes. Throws InputError for an unknown key or a wrong value. The
/// message names `file`, the line and the permitted keys or values.
View view_from_toml(const std::filesystem::path& file, const toml::table& table);

}  // namespace pelage
