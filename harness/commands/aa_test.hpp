#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage aa-test: counts wrong verdicts of `pelage compare` on this machine. The command compares timings
/// whose true difference is known. The exit code is 1 if the rendered picture differs too much from the
/// reference picture.
void add_aa_test(CLI::App& app, Chosen& chosen);

}  // namespace pelage
