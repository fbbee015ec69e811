#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage export RESULTS... --csv FILE|- [--raw]: reads journal files of recorded results and writes them as
/// CSV.
void add_export(CLI::App& app, Chosen& chosen);

}  // namespace pelage
