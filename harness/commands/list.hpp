#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage list [EXPERIMENT|FILE.toml] [--preset NAME] [--json]: lists the experiments, or the cases of one
/// experiment.
void add_list(CLI::App& app, Chosen& chosen);

}  // namespace pelage
