#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage devices [--measure] [--json]: lists the OpenCL devices. The exit code is 1 if the measurement of a
/// device fails, and 3 if there is no device.
void add_devices(CLI::App& app, Chosen& chosen);

}  // namespace pelage
