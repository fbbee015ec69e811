#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage check [STAGE...] [--device D] [--full]: compares the results of a device with the double-precision
/// reference, stage by stage. The exit code is 1 if a difference exceeds its limit.
void add_check(CLI::App& app, Chosen& chosen);

}  // namespace pelage
