#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage export RESULTS... --csv FILE|- [--raw]
void add_export(CLI::App& app, Chosen& chosen);

}  // namespace pelage
