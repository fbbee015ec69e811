#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage tune [STAGE...]: times the values of the kernels' tuning axes on a device and stores the fastest
/// values in a file for `pelage run --tuning`. If the shipped values fail their check, nothing is stored and
/// the exit code is 1.
void add_tune(CLI::App& app, Chosen& chosen);

}  // namespace pelage
