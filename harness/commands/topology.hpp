// pelage topology MODEL|FILE: prints the numbers of masses and springs of each mass-spring topology on a
// model, and draws the topologies.
#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

void add_topology(CLI::App& app, Chosen& chosen);

}  // namespace pelage
