#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage export RESULTS... --csv FILE|- [--raw]: writes the rows of journals as CSV.
void add_export(CLI::App& app, Chosen& chosen);

}  // namespace pelage
