#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage render [SCENE.toml] -o IMAGE: one picture of a scene, by the shells on a device or by the
/// reference.
void add_render(CLI::App& app, Chosen& chosen);

}  // namespace pelage
