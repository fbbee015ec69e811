#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage scene [SCENE.toml] [--set KEY=VALUE]: prints the scene with all overrides as TOML to stdout. Each
/// key has a comment.
void add_scene(CLI::App& app, Chosen& chosen);

}  // namespace pelage
