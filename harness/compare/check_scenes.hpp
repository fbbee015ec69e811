// Scenes for `pelage check`, which compares a device with the reference.
#pragma once
#include <string>
#include <vector>

#include "harness/scene/scene.hpp"

namespace pelage {

struct CheckScene {
  std::string name;  ///< "torus, 16 layers, curly"
  Scene scene;
  bool motion = true;  ///< whether tips and masks are compared in addition to pictures
};

/// Returns a torus with curly, wet and windy fur, and a bunny with all three. If `full` is set, returns the
/// eight models of Table 1 with 16 and 64 layers each, and a torus of 5.0 million triangles.
std::vector<CheckScene> check_scenes(bool full);

}  // namespace pelage
