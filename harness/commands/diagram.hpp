// pelage diagram: draws the insets, sections and overlays of the papers' figures (docs/experiments.md).
#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

void add_diagram(CLI::App& app, Chosen& chosen);

}  // namespace pelage
