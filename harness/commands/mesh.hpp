#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage mesh MODEL|FILE [-o out.ply] [--faces N] [--keep-uv] [--rotate X,Y,Z] [--atlas uv.png]: prepares a
/// mesh; prints counts, topology, what was done to it, and how good its UV map is.
void add_mesh(CLI::App& app, Chosen& chosen);

}  // namespace pelage
