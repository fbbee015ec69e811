// Scenes as TOML: reading, overriding, checking and writing, all driven by the one table of scene_keys.cpp.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "harness/scene/scene.hpp"

namespace pelage {

/// Reads a scene file; keys that it does not give keep their defaults, so an empty file is the default scene.
/// Relative paths in it (pictures, a mesh file as model) are taken from its own folder and made absolute.
/// Throws InputError naming file, line and key and what would be right: for a missing, unreadable or
/// malformed file, unknown keys, wrong types, values that are out of range or not finite, and values that
/// contradict each other.
Scene read_scene(const std::filesystem::path& path);

/// The same from text; `name` stands for the file in errors, `folder` is where relative paths start.
Scene parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder = ".");

/// Overrides one key: "fur.length=0.1". The value is TOML, except that strings need no quotes; relative paths
/// start at the working folder. `source` opens the error's text. Only this key is checked, not how it goes
/// with others: call check_scene after the last override. Throws InputError.
void apply_set(Scene& scene, std::string_view assignment, const std::string& source = "--set");

/// Throws InputError when a value is out of its range or does not go with the others. `source` opens the
/// error's text.
void check_scene(const Scene& scene, const std::string& source = "scene");

/// The resolved scene: every key, with its meaning, unit, range and default as a comment. parse_scene reads
/// it back to the same scene, bit by bit.
std::string write_scene(const Scene& scene);

/// 16 hex digits of the resolved scene, the same on every machine: a path counts by what its file holds, not
/// by where it lies.
std::string scene_hash(const Scene& scene);

}  // namespace pelage
