// The options by which a command is told its scene: a file, a model, overrides, a size.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "harness/commands/command.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/scene/scene.hpp"

namespace pelage {

struct SceneOptions {
  std::string file;              ///< empty: the default scene
  std::string model;             ///< empty: the scene's own
  std::string size;              ///< "WxH"; empty: the scene's own
  std::vector<std::string> set;  ///< key=value
};

/// Adds SCENE.toml, --set and, when the command draws, --model and --size.
void add_scene_options(CLI::App& command, SceneOptions& options, bool draws);

/// The scene they mean, checked. Throws InputError.
Scene resolve_scene(const SceneOptions& options);

/// The scene's mesh; says on stderr what goes on while it is prepared, and what is
/// wrong with its UV map.
std::shared_ptr<const Mesh> load_scene_mesh(const Scene& scene);

}  // namespace pelage
