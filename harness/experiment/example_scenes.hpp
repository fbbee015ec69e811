// The example scenes of pelage (folder examples/), which have names.
#pragma once
#include <filesystem>
#include <string>

namespace pelage {

/// Returns the path of an example scene, whose file is named NAME or NAME.toml. The InputError for an unknown
/// name lists all examples.
std::filesystem::path example_scene(const std::string& name);

/// Returns the path of a scene file, relative to `folder`. If there is no such file, and `name` contains no
/// '/', returns example_scene().
std::filesystem::path file_or_example(const std::filesystem::path& folder, const std::string& name);

}  // namespace pelage
