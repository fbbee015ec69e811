// Scenes for `pelage check`, which compares a device with the reference.
#pragma once
#include <string>
#include <vector>

#include "harness/scene/scene.hpp"

namespace pelage {

struct CheckScene {
  std::string name;  ///< such as "torus, 16 layers, curly"
  Scene scene;
  bool motion = true;  ///< whether strand tips and wetness masks are compared too
};

/// If `full` is false, returns four scenes: a torus with curly, with wet and with windy fur, and a bunny with
/// all three effects at once. If `full` is true, returns 49 other scenes. 48 of them are the eight models of
/// Silva's Table 1, each with 16 and with 64 layers, and with curly, with wet and with windy fur. The last
/// scene is a torus of 5.0 million triangles with all three effects.
std::vector<CheckScene> check_scenes(bool full);

}  // namespace pelage
