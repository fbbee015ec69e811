// The example scenes of pelage (folder examples/), which have names.
#pragma once
#include <filesystem>
#include <string>

namespace pelage {

/// Returns the path of an example scene. `name` is the name of its file, with or without ".toml". Throws
/// InputError if there is no example with this name; the message lists all examples.
std::filesystem::path example_scene(const std::string& name);

/// Returns the path of a scene file. `name` is a path relative to `folder`. If there is no such file, and
/// `name` contains no '/', returns example_scene().
std::filesystem::path file_or_example(const std::filesystem::path& folder, const std::string& name);

}  // namespace pelage
