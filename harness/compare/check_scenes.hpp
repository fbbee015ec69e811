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

/// The scenes of shells come first. If `full` is false, there are four: one torus with curly fur, one with
/// wet fur and one with windy fur, and a bunny with all three effects at once. If `full` is true, there are
/// 49 others. 48 of them combine each of the eight models of Silva's Table 1 with 16 or 64 layers and with
/// curly, wet or windy fur. The last scene of shells is a torus of 5.0 million triangles with all three
/// effects.
///
/// Then come the scenes of strands. If `full` is false, there is one: a torus with 20,000 strands and all
/// kinds of light. If `full` is true, there are nine: bunny, horse and torus with 100,000 strands in three
/// looks, 800 x 600 pixels each.
std::vector<CheckScene> check_scenes(bool full);

}  // namespace pelage
