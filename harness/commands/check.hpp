#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage check [STAGE...] [--device D] [--full]: compares the results of a device with the double-precision
/// reference, stage by stage. Exit code 1 if a result exceeds its limit.
void add_check(CLI::App& app, Chosen& chosen);

}  // namespace pelage
