// pelage topology
#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

void add_topology(CLI::App& app, Chosen& chosen);

}  // namespace pelage
