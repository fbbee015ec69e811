// Functions that read, override, check and write scenes as TOML. They use the table of keys in
// scene_keys.cpp.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "harness/scene/scene.hpp"

namespace pelage {

/// Reads a scene file. Keys that are absent from the file keep their defaults, so an empty file gives the
/// default scene. Relative paths in the file (pictures, a mesh file as model) start at the file's folder and
/// are made absolute. Throws InputError with file, line, key and permitted values if the file is missing,
/// unreadable or malformed, if a key is unknown, or if a value has a wrong type, is out of range, is not
/// finite or contradicts another value.
Scene read_scene(const std::filesystem::path& path);

/// Parses the text of a scene file like read_scene(). Errors call the file `name`; relative paths start at
/// `folder`.
Scene parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder = ".");

/// Overrides one key by an assignment such as "fur.length=0.1". The value is TOML, except that strings need
/// no quotes. Relative paths start at the working folder. Error texts begin with `source`. The function
/// checks this key alone; call check_scene() after the last override to check the consistency of all keys.
/// Throws InputError.
void apply_set(Scene& scene, std::string_view assignment, const std::string& source = "--set");

/// Throws InputError if a value is out of its range or contradicts another value. Error texts begin with
/// `source`.
void check_scene(const Scene& scene, const std::string& source = "scene");

/// Writes a scene as TOML with all keys. A comment gives each key's meaning, unit, range and default.
/// parse_scene() reads the text back to a bitwise identical scene.
std::string write_scene(const Scene& scene);

/// Hash of all keys of a scene, 16 hexadecimal digits, the same on every machine. For a path, the content of
/// its file is hashed instead of the path itself.
std::string scene_hash(const Scene& scene);

}  // namespace pelage
