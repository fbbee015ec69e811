#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage scene [SCENE.toml] [--set KEY=VALUE]: prints the resolved scene as commented TOML to stdout.
void add_scene(CLI::App& app, Chosen& chosen);

}  // namespace pelage
