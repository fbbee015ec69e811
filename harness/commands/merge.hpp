#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage merge OUT RESULTS...: writes the rows of shards (parts of a run) and of whole runs into the new
/// folder OUT, and prints missing shards and cases to stdout.
void add_merge(CLI::App& app, Chosen& chosen);

}  // namespace pelage
