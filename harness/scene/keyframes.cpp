#include "harness/scene/keyframes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "harness/error.hpp"
#include "harness/scene/scene_keys.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {
namespace {

/// Returns the value at the fraction t (0 to below 1) of the time between two keyframes.
KeyValue between(const KeyValue& a, const KeyValue& b, double t) {
  const auto mix = [&](float from, float to) {
    return static_cast<float>(double(from) + t * (double(to) - double(from)));
  };
  if (const auto* from = std::get_if<float>(&a)) return mix(*from, std::get<float>(b));
  if (const auto* from = std::get_if<glm::vec3>(&a)) {
    const auto& to = std::get<glm::vec3>(b);
    return glm::vec3(mix(from->x, to.x), mix(from->y, to.y), mix(from->z, to.z));
  }
  return a;
}

KeyValue value_at(const std::vector<Keyframe>& frames, double seconds) {
  const auto next = std::upper_bound(frames.begin(), frames.end(), seconds,
                                     [](double time, const Keyframe& frame) { return time < frame.time; });
  if (next == frames.begin()) return frames.front().value;
  const Keyframe& last = next[-1];
  if (next == frames.end()) return last.value;
  return between(last.value, next->value, (seconds - last.time) / (next->time - last.time));
}

/// Returns the value of a force that is farthest from 0 at any time.
const KeyValue& strongest(const KeyTrack& track) {
  const auto size = [](const Keyframe& frame) {
    if (const auto* number = std::get_if<float>(&frame.value)) return std::abs(*number);
    const auto* vector = std::get_if<glm::vec3>(&frame.value);
    return vector ? glm::length(*vector) : 0.0f;
  };
  return std::ranges::max_element(track.frames, {}, size)->value;
}

void check_track(const KeyTrack& track, const std::vector<Key>& keys, const std::string& source) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: keyframes.\"{}\": {}", source, track.key, what));
  };
  const Key* key = find_key(keys, track.key);
  if (!key) refuse("no such key; `pelage scene` prints all keys");
  if (!may_have_keyframes(*key)) refuse("this key cannot change over time");
  if (track.frames.empty() || track.frames.size() > most_keyframes)
    refuse(fmt::format("has {} keyframes; give 1 to {}", track.frames.size(), most_keyframes));
  for (std::size_t i = 0; i < track.frames.size(); ++i) {
    const Keyframe& frame = track.frames[i];
    if (!(frame.time >= 0 && frame.time <= most_keyframe_time))
      refuse(fmt::format("the time {} s is out of range; give 0 to {} s", frame.time, most_keyframe_time));
    if (i > 0 && !(frame.time > track.frames[i - 1].time))
      refuse(fmt::format("the time {} s is not after {} s; give ascending times", frame.time,
                         track.frames[i - 1].time));
    if (frame.value.index() != key_value(*key).index())
      refuse(fmt::format("a value has a wrong type; give {}", describe_range(*key)));
  }
}

}  // namespace

Scene scene_at(const Scene& scene, double seconds) {
  if (!std::isfinite(seconds)) throw InputError(fmt::format("keyframes: the time {} is not finite", seconds));
  Scene result = scene;
  result.keyframes = {};
  if (scene.keyframes.tracks.empty()) return result;
  const std::vector<Key> keys = scene_keys(result);
  for (const KeyTrack& track : scene.keyframes.tracks) {
    const Key* key = find_key(keys, track.key);
    if (!key || track.frames.empty())
      throw InputError(fmt::format("keyframes.\"{}\": no such key, or no keyframe", track.key));
    set_key(*key, value_at(track.frames, seconds));
  }
  const std::string source = fmt::format("keyframes at {} s", seconds);
  check_scene(result, source);
  // The motion up to this time has the earlier forces, and the other keys' values at this time.
  for (const KeyTrack& track : scene.keyframes.tracks)
    if (is_force_key(track.key)) set_key(*find_key(keys, track.key), strongest(track));
  if (forces_change(scene)) check_scene(result, source);
  for (const KeyTrack& track : scene.keyframes.tracks) {
    if (!is_force_key(track.key)) continue;
    set_key(*find_key(keys, track.key), value_at(track.frames, 0));
    result.keyframes.tracks.push_back(track);
  }
  return result;
}

bool is_force_key(std::string_view key) {
  return key == "dynamics.gravity" || key.starts_with("dynamics.poke.") ||
         (key.starts_with("dynamics.wind.") && key != "dynamics.wind.gust_at");
}

bool forces_change(const Scene& scene) {
  return std::ranges::any_of(scene.keyframes.tracks, is_force_key, &KeyTrack::key);
}

DynamicsScene dynamics_of_frame(const Scene& scene, int frame) {
  Scene at;
  at.dynamics = scene.dynamics;
  const double seconds = double(frame) * at.dynamics.substeps * double(at.dynamics.step);
  const std::vector<Key> keys = scene_keys(at);
  for (const KeyTrack& track : scene.keyframes.tracks)
    if (is_force_key(track.key)) set_key(*find_key(keys, track.key), value_at(track.frames, seconds));
  for (const auto& [name, direction] : {std::pair("wind.direction", at.dynamics.wind.direction),
                                        std::pair("poke.along", at.dynamics.poke.along)})
    if (direction == glm::vec3(0))
      throw InputError(fmt::format("keyframes at {} s: dynamics.{}: points nowhere", seconds, name));
  return at.dynamics;
}

bool may_have_keyframes(const Key& key) {
  return key.name != "model" && key.name != "pipeline" && !key.name.starts_with("mesh.") &&
         key.name != "strands.groom" && !key.name.starts_with("strands.file");
}

KeyValue key_value(const Key& key) {
  return std::visit(
      [&](const auto* slot) -> KeyValue {
        using T = std::remove_cvref_t<decltype(*slot)>;
        if constexpr (std::is_constructible_v<KeyValue, std::in_place_type_t<T>, const T&>)
          return KeyValue(std::in_place_type<T>, *slot);
        else
          throw InputError(fmt::format("{}: this key cannot change over time", key.name));
      },
      key.slot);
}

void set_key(const Key& key, const KeyValue& value) {
  std::visit(
      [&](auto* slot) {
        using T = std::remove_reference_t<decltype(*slot)>;
        if constexpr (std::is_constructible_v<KeyValue, std::in_place_type_t<T>, const T&>) {
          if (const T* given = std::get_if<T>(&value)) {
            *slot = *given;
            return;
          }
        }
        throw InputError(fmt::format("keyframes.\"{}\": a value has a wrong type; give {}", key.name,
                                     describe_range(key)));
      },
      key.slot);
}

void check_keyframes(const Scene& scene, const std::string& source) {
  if (scene.keyframes.tracks.empty()) return;
  Scene copy = scene;
  const std::vector<Key> keys = scene_keys(copy);
  std::set<double> times;
  std::set<std::string> names;
  for (const KeyTrack& track : scene.keyframes.tracks) {
    check_track(track, keys, source);
    if (!names.insert(track.key).second)
      throw InputError(fmt::format("{}: keyframes.\"{}\": occurs twice", source, track.key));
    for (const Keyframe& frame : track.frames) times.insert(frame.time);
  }
  for (const double time : times) {
    try {
      scene_at(scene, time);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", source, error.what()));
    }
  }
}

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
