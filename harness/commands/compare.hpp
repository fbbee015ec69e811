#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage compare A [B] [--by device|variant|axes.KEY] [--threshold 5%] [--fail-on-regression] [--json]. Exit
/// 5 when asked to fail and a case is slower or lost.
void add_compare(CLI::App& app, Chosen& chosen);

}  // namespace pelage
