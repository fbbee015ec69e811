// Functions that read, override, check and write scenes as TOML. They use the table of keys in
// scene_keys.cpp.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/scene/scene.hpp"

namespace pelage {

/// Reads a scene file. Keys that are absent from the file keep their defaults, so an empty file gives the
/// default scene. Relative paths in the file (of pictures and of a mesh file) are resolved against the file's
/// folder and made absolute. Throws InputError if the file cannot be read or parsed, if a key is unknown, or
/// if a value is not permitted. A value is not permitted if it has a wrong type, is out of range, is not
/// finite or contradicts another value. The error text names the file and, where they apply, the line, the
/// key and the permitted values.
Scene read_scene(const std::filesystem::path& path);

/// Parses the text of a scene file as read_scene() does. `name` is the name of the file in error texts.
/// Relative paths are resolved against `folder`. Keys that are absent from the text have the values of
/// `base`.
Scene parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder = ".",
                  const Scene& base = {});

/// Overrides one key by an assignment such as "fur.length=0.1". The value is TOML, except that strings need
/// no quotes. Relative paths are resolved against the working directory. Error texts begin with `source`. The
/// function checks this key alone; call check_scene() after the last override to check the consistency of all
/// keys. The value applies at all times: keyframes of the key are removed. Throws InputError.
void apply_set(Scene& scene, std::string_view assignment, const std::string& source = "--set");

/// Throws InputError if a value is out of its range or contradicts another value. Error texts begin with
/// `source`.
void check_scene(const Scene& scene, const std::string& source = "scene");

/// Returns a scene as TOML text with all keys. A comment beside each key gives its meaning, unit, range and
/// default. parse_scene() returns a bitwise identical scene from this text.
std::string write_scene(const Scene& scene);

/// Returns the keys whose values differ from the defaults, with their values as TOML. Lists and keyframes are
/// entries, too. A path is reduced to the name of its file. A value of more than 2000 bytes is replaced by
/// its length.
std::vector<std::pair<std::string, std::string>> changed_keys(const Scene& scene);

/// Returns a hash of all keys, values and keyframes of a scene as 16 hexadecimal digits. The hash is the same
/// on every machine. If a value is a path, the content of the file is hashed instead of the path. The key
/// `pipeline` is left out, because it chooses how the scene is drawn and not what: rows of results and
/// animations record the pipeline beside this hash. The default values of `fur.layer_correction` and
/// `dynamics.springs.vertices` are left out, too, so that the hashes of older rows stay valid.
std::string scene_hash(const Scene& scene);

}  // namespace pelage
