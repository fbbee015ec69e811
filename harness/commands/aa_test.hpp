#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage aa-test: tests the verdicts of `pelage compare` on this machine with timings whose true difference
/// is known. The exit code is 1 if the picture of a side fails its check.
void add_aa_test(CLI::App& app, Chosen& chosen);

}  // namespace pelage
