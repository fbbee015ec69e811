#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage scene [SCENE.toml] [--set KEY=VALUE]: the resolved scene as commented TOML on stdout.
void add_scene(CLI::App& app, Chosen& chosen);

}  // namespace pelage
