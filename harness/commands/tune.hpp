#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage tune [STAGE...]: times the values of the kernels' tuning axes on a device and stores the fastest
/// values in a file for `pelage run --tuning`. A tuning axis is a parameter of a kernel that affects only its
/// speed. Before the search in a stage, the command checks the output of this stage with the default values.
/// If this output is wrong, the command stores no values for this stage, skips the remaining stages and
/// returns exit code 1.
void add_tune(CLI::App& app, Chosen& chosen);

}  // namespace pelage
