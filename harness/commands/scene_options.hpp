// The command-line options that define a scene: a file, a model, overrides and a size.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "harness/commands/commands.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/scene/scene.hpp"

namespace pelage {

struct SceneOptions {
  /// Scene file, or name of an example; empty: the default scene. With `case_name`: an experiment.
  std::string file;
  std::string case_name;  ///< case of the experiment `file`, whose scene is used; empty: `file` is a scene
  std::string model;      ///< name of a model, or mesh file; empty: the model of the scene file
  std::string up;         ///< value for the scene key mesh.up; empty: the value in the scene file
  std::string size;  ///< picture size "WxH" in pixels; empty: image.width and image.height of the scene file
  std::vector<std::string> set;  ///< overrides, key=value
};

/// Adds the positional argument SCENE and the options --case, --set, --model and --up to the command. If
/// `draws` is true, also adds the option --size.
void add_scene_options(CLI::App& command, SceneOptions& options, bool draws);

/// Adds the option --up, which sets the scene key mesh.up.
void add_up_option(CLI::App& command, std::string& up);

/// Returns the scene with all overrides. Throws InputError for unknown keys and values out of range.
Scene resolve_scene(const SceneOptions& options);

/// Returns the scene's mesh. Prints the steps of its preparation and the defects of its UV map to stderr.
std::shared_ptr<const Mesh> load_scene_mesh(const Scene& scene);

}  // namespace pelage
