#pragma once
#include <string>

#include "harness/commands/command.hpp"

namespace pelage {

/// pelage completion bash: prints a script for bash that completes the commands, options and values of
/// pelage. `app` must have all commands when the command runs, and must outlive it.
void add_completion(CLI::App& app, Chosen& chosen);

}  // namespace pelage
