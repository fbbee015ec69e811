#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage run EXPERIMENT|FILE.toml...: times the cases of experiments and prints the folder of the results to
/// stdout. The exit code is 1 if a case's result has another status than `ok`, and 2 if a case has invalid
/// input.
void add_run(CLI::App& app, Chosen& chosen);

}  // namespace pelage
