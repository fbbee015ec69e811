// The example scenes of pelage (folder examples/), which have names.
#pragma once
#include <filesystem>
#include <string>

namespace pelage {

/// Returns the path of a scene file, relative to `folder`. If there is no such file, and `name` contains no
/// '/', returns the path of the example NAME or NAME.toml. The InputError for an unknown name lists all
/// examples.
std::filesystem::path file_or_example(const std::filesystem::path& folder, const std::string& name);

}  // namespace pelage
