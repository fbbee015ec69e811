#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage run EXPERIMENT|FILE.toml... Exit 1 when a row is not ok, 2 when one failed on its input. Prints the
/// folder of the results to stdout.
void add_run(CLI::App& app, Chosen& chosen);

}  // namespace pelage
