// pelage topology MODEL|FILE: prints the size of each spring network over a model, and draws the networks.
#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

void add_topology(CLI::App& app, Chosen& chosen);

}  // namespace pelage
