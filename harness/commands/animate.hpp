#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage animate [SCENE.toml] -o FOLDER: draws the frames of an animation of a scene, and joins them to a
/// GIF or MP4 file if asked to.
void add_animate(CLI::App& app, Chosen& chosen);

}  // namespace pelage
