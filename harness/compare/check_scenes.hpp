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

/// Returns four scenes: a torus with curly, with wet and with windy fur, and a bunny with all three effects
/// at once. If `full` is set, returns scenes of the eight models of S Table 1 with 16 and 64 layers instead,
/// and a torus of 5.0 million triangles.
std::vector<CheckScene> check_scenes(bool full);

}  // namespace pelage
