// The scenes of single pictures: the scene at a time, and the comparison of two such scenes.
#pragma once
#include <functional>
#include <string_view>

#include "harness/scene/scene.hpp"

namespace pelage {

/// Returns the scene that `pelage render --set dynamics.time=SECONDS` draws: every key has its value at the
/// time `seconds`, dynamics.time is `seconds`, and there are no keyframes. Keyframes of dynamics.time have no
/// effect. Throws InputError like scene_at().
Scene picture_scene(const Scene& scene, float seconds);

/// True if all keys and lists of the two scenes have the same values, bit for bit. Keys for which
/// `may_differ` returns true are not compared. Both scenes must have no keyframes.
bool equal_except(const Scene& a, const Scene& b, const std::function<bool(std::string_view)>& may_differ);

}  // namespace pelage
