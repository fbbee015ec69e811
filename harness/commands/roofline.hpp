#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage roofline [EXPERIMENT]: times the kernels of a frame. Compares their rates (bytes and operations per
/// second) with the measured peak rates of the device. Leaves out each case whose picture fails its check;
/// the exit code is then 1.
void add_roofline(CLI::App& app, Chosen& chosen);

}  // namespace pelage
