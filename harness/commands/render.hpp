#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage render [SCENE.toml] -o IMAGE: draws one picture of a scene with the OpenCL pipeline, the
/// double-precision reference or the OpenGL baseline.
void add_render(CLI::App& app, Chosen& chosen);

}  // namespace pelage
