#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage compare A [B] [--by device|variant|axes.KEY] [--threshold 5%] [--fail-on-regression] [--json]
///
/// Compares the times of two sets of results. With --fail-on-regression the exit code is 5 if a case is
/// slower in B or has no time in B.
void add_compare(CLI::App& app, Chosen& chosen);

}  // namespace pelage
