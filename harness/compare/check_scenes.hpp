// Scenes for `pelage check`, which compares the frames of a device with those of the double-precision
// reference.
#pragma once
#include <string>
#include <vector>

#include "harness/scene/scene.hpp"

namespace pelage {

struct CheckScene {
  std::string name;  ///< such as "torus, 16 layers, curly"
  Scene scene;
  bool motion = true;  ///< true: compare pictures, strand tips and masks; false: only pictures
};

/// If `full` is false, returns four scenes: one torus with curly fur, one with wet fur and one with windy
/// fur, and a bunny with all three effects at once. If `full` is true, returns 49 other scenes. 48 of them
/// combine each of the eight models of Silva's Table 1 with 16 or 64 layers and with curly, wet or windy fur.
/// The last scene is a torus of 5.0 million triangles with all three effects.
std::vector<CheckScene> check_scenes(bool full);

}  // namespace pelage
