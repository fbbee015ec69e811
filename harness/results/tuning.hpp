// Tuning files: the values of the kernels' tunable axes, found for one device by `pelage tune` or by hand.
#pragma once
#include <filesystem>
#include <map>
#include <string>

namespace pelage {

/// AXIS = whole number, at the top or in tables named after a room of kernels/ (the tables only order them).
/// Throws InputError naming file, line and key.
std::map<std::string, int> read_tuning(const std::filesystem::path& file);

}  // namespace pelage
