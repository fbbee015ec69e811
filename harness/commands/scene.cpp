#include <fmt/format.h>

#include "harness/commands/commands.hpp"
#include "harness/commands/scene_options.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {
namespace {

int print_scene(const SceneOptions& options) {
  fmt::print("{}", write_scene(resolve_scene(options)));
  return 0;
}

}  // namespace

void add_scene(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<SceneOptions>(
      app, chosen, "scene",
      "Print a scene with all overrides: value, meaning, unit, range and default of each key", print_scene);
  add_scene_options(command, options, false);
}

}  // namespace pelage
