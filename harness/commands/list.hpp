#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage list [EXPERIMENT|FILE.toml] [--preset NAME] [--json]
void add_list(CLI::App& app, Chosen& chosen);

}  // namespace pelage
