#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage check [STAGE...] [--device D] [--full]: what a device computes against the double-precision
/// reference, stage by stage. Exit 1 when a limit is broken.
void add_check(CLI::App& app, Chosen& chosen);

}  // namespace pelage
