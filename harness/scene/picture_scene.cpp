#include "harness/scene/picture_scene.hpp"

#include "harness/scene/keyframes.hpp"
#include "harness/scene/scene_keys.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {

Scene picture_scene(const Scene& scene, float seconds) {
  Scene at = scene;
  std::erase_if(at.keyframes.tracks, [](const KeyTrack& track) { return track.key == "dynamics.time"; });
  at.dynamics.time = seconds;
  return scene_at(at, double(seconds));
}

bool equal_except(const Scene& a, const Scene& b, const std::function<bool(std::string_view)>& may_differ) {
  Scene from = a, to = b;
  const std::vector<Key> values = scene_keys(from), changed = scene_keys(to);
  for (std::size_t i = 0; i < changed.size(); ++i)
    if (may_differ(changed[i].name)) set_key(changed[i], key_value(values[i]));
  // The texts of two scenes are equal only if all values have the same bits. With ==, 0 equals -0.
  return write_scene(from) == write_scene(to);
}

}  // namespace pelage
