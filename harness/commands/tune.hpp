#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage tune [STAGE...]: searches the kernels' tuning axes on a device and stores the fastest values in a
/// file for `pelage run --tuning`. Exit code 1 if the shipped values fail their check; then nothing is
/// stored.
void add_tune(CLI::App& app, Chosen& chosen);

}  // namespace pelage
