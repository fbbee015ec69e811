#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage report RESULTS... -o DIR. Prints the papers' tables to stdout.
void add_report(CLI::App& app, Chosen& chosen);

}  // namespace pelage
