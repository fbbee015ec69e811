#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage mesh MODEL|FILE [-o out.ply] [--faces N] [--keep-uv] [--rotate X,Y,Z] [--atlas uv.png]: prepares a
/// mesh. Prints its numbers of vertices, edges and faces, its topology, the repairs to the mesh and the
/// quality of its UV map.
void add_mesh(CLI::App& app, Chosen& chosen);

}  // namespace pelage
