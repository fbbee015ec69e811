#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage report RESULTS... -o DIR: writes a report into DIR and prints its tables to stdout.
void add_report(CLI::App& app, Chosen& chosen);

}  // namespace pelage
