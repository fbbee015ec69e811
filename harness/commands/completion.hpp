#pragma once
#include <string>

#include "harness/commands/command.hpp"

namespace pelage {

/// pelage completion bash: prints a script for bash that completes the commands, options and values of
/// pelage. `app` is the parser with all commands of pelage. `chosen` receives a function that uses `app`, so
/// `app` must exist as long as this function.
void add_completion(CLI::App& app, Chosen& chosen);

}  // namespace pelage
