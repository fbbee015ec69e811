// Scene keys that change over time, and the scenes of single pictures.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace pelage {

struct DynamicsScene;
struct Scene;
struct Key;

/// The value of a scene key.
using KeyValue = std::variant<float, int, std::uint32_t, bool, std::string, std::filesystem::path, glm::vec3>;

struct Keyframe {
  double time = 0;  ///< s, 0 to 3600
  KeyValue value;
  bool operator==(const Keyframe&) const = default;
};

/// The values of one scene key over time, in ascending order of time.
struct KeyTrack {
  std::string key;  ///< dotted name, for instance "strands.fraction"
  std::vector<Keyframe> frames;
  bool operator==(const KeyTrack&) const = default;
};

/// The table [keyframes] of a scene file. Each line gives the values of a key at some times (s), for instance
/// "strands.fraction" = [[0.0, 1.0], [5.0, 0.1]].
struct Keyframes {
  std::vector<KeyTrack> tracks;  ///< at most one per key
  bool operator==(const Keyframes&) const = default;
};

/// Greatest permitted number of keyframes of one key, and greatest permitted time of a keyframe, s.
inline constexpr std::size_t most_keyframes = 1000;
inline constexpr double most_keyframe_time = 3600;

/// True for the keys of the forces on the fur: gravity, wind and local force. With keyframes, they have the
/// value of each simulated frame (dynamics_of_frame()), because the motion depends on all earlier forces.
bool is_force_key(std::string_view key);

/// Returns the scene at the time `seconds`. It has only the keyframes of forces, whose keys have their value
/// at the time 0. Numbers (except whole numbers) and vectors are
/// interpolated linearly between two keyframes. Whole numbers, strings, paths and truth values have the value
/// of the last keyframe that is reached. Before the first keyframe, a key has the value of the first
/// keyframe, and after the last keyframe that of the last one. Throws InputError if the scene at this time is
/// not valid, for instance because an interpolated direction is zero, or if it does not permit a force of
/// another time.
Scene scene_at(const Scene& scene, double seconds);

/// True if the scene has keyframes of forces.
bool forces_change(const Scene& scene);

/// Returns the dynamics of the simulated frame number `frame`, from 0. Forces with keyframes have their value
/// at the time at which the frame begins, frame * substeps * step. Throws InputError if a direction is then
/// zero.
DynamicsScene dynamics_of_frame(const Scene& scene, int frame);

/// True if the key may have keyframes. The model, the options of its preparation and the
/// pipeline may not.
bool may_have_keyframes(const Key& key);

/// Returns the key's value. The key is one of scene_keys().
KeyValue key_value(const Key& key);

/// Assigns the value to the key. Throws InputError if the value has another type than the key.
void set_key(const Key& key, const KeyValue& value);

/// Throws InputError if a track is not valid, or if the scene is not valid at the time of a keyframe. Error
/// texts begin with `source`.
void check_keyframes(const Scene& scene, const std::string& source);

/// Returns the scene that `pelage render --set dynamics.time=SECONDS` draws: every key has its value at the
/// time `seconds`, dynamics.time is `seconds`, and there are only the keyframes of forces. Keyframes of
/// dynamics.time have no effect. Throws InputError like scene_at().
Scene picture_scene(const Scene& scene, float seconds);

/// True if all keys and lists of the two scenes have the same values, bit for bit. Keys for which
/// `may_differ` returns true are not compared.
bool equal_except(const Scene& a, const Scene& b, const std::function<bool(std::string_view)>& may_differ);

}  // namespace pelage
