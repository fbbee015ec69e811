#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage tune [STAGE...]: searches the kernels' tuning axes on a device and stores what wins for run
/// --tuning. Exit 1 when the shipped configuration itself fails its check: then nothing is stored.
void add_tune(CLI::App& app, Chosen& chosen);

}  // namespace pelage
