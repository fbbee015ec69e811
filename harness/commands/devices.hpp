#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage devices [--measure] [--json]. Exit 1 when a device fails its measurement, 3 when there is none.
void add_devices(CLI::App& app, Chosen& chosen);

}  // namespace pelage
