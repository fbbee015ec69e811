// pelage water: prints where the water of a scene is over time.
#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

void add_water(CLI::App& app, Chosen& chosen);

}  // namespace pelage
