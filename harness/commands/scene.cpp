#include <fmt/format.h>

#include "harness/commands/commands.hpp"
#include "harness/commands/scene_options.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {

void add_scene(CLI::App& app, Chosen& chosen) {
  auto options = std::make_shared<SceneOptions>();
  CLI::App* command = app.add_subcommand(
      "scene", "Print a scene with all overrides: value, meaning, unit, range and default of each key");
  add_scene_options(*command, *options, false);
  command->callback([options, &chosen] {
    chosen = [options] {
      fmt::print("{}", write_scene(resolve_scene(*options)));
      return 0;
    };
  });
}

}  // namespace pelage
