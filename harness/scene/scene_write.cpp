#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "harness/file_hash.hpp"
#include "harness/hash.hpp"
#include "harness/scene/scene_keys.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {
namespace {

/// Returns the text as a quoted TOML string, with escape sequences.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

/// Returns the shortest decimal number that is parsed as the same float or double. The number has a point or
/// an exponent, because TOML parses other numbers as integers.
template <class Real>
std::string number(Real value) {
  std::string digits = fmt::format("{}", value);
  if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
  return digits;
}

/// Returns the value as TOML. If the value is absent, returns an empty string. Only a droplet's uv and a
/// droplet's point can be absent.
template <class T>
std::string text(const T& value) {
  if constexpr (std::is_same_v<T, float>)
    return number(value);
  else if constexpr (std::is_same_v<T, glm::vec2>)
    return fmt::format("[{}, {}]", number(value.x), number(value.y));
  else if constexpr (std::is_same_v<T, glm::vec3>)
    return fmt::format("[{}, {}, {}]", number(value.x), number(value.y), number(value.z));
  else if constexpr (std::is_arithmetic_v<T>)
    return fmt::format("{}", value);  // a truth value gives "true" or "false"
  else if constexpr (requires { value.has_value(); })
    return value ? text(*value) : std::string{};
  else if constexpr (std::is_same_v<T, std::string>)
    return quoted(value);
  else
    return quoted(value.string());
}

std::string value_text(const Key& key) {
  return std::visit([](const auto* slot) { return text(*slot); }, key.slot);
}

std::string line(const Key& key, std::string_view word, const std::string& note) {
  return fmt::format("{:<35} # {} [{}{}]\n", fmt::format("{} = {}", word, value_text(key)), key.help,
                     describe_range(key), note);
}

std::string write_list(const KeyList& list) {
  std::string out;
  for (std::size_t i = 0; i < list.size(); ++i) {
    out += fmt::format("\n[[{}]]\n", list.name);
    for (const Key& key : list.keys(i))
      if (!value_text(key).empty()) out += line(key, key.name, "");
  }
  return out;
}

/// Returns a TOML comment that describes the keys of a list's entries. write_scene() adds this comment to
/// scenes in which the list is empty. `standard` has one entry with default values.
std::string describe_list(const KeyList& standard) {
  std::string out = fmt::format("\n# This scene has no [[{}]]. The keys of an entry are:\n", standard.name);
  for (const Key& key : standard.keys(0)) {
    const std::string value = value_text(key);
    out += fmt::format("#   {:<30}# {} [{}{}]\n", key.name, key.help, describe_range(key),
                       value.empty() ? "" : "; default " + value);
  }
  return out;
}

/// Calls `use` with the key and the time of each keyframe of a scene, after it has set the key to the
/// keyframe's value in a copy of the scene.
template <class Use>
void for_keyframes(const KeyTrack& track, const Use& use) {
  Scene scratch;
  const std::vector<Key> keys = scene_keys(scratch);
  const Key* key = find_key(keys, track.key);
  for (std::size_t i = 0; key && i < track.frames.size(); ++i) {
    set_key(*key, track.frames[i].value);
    use(*key, track.frames[i].time);
  }
}

/// Returns the keyframes of a key as a TOML array of pairs [time in s, value].
std::string pairs_text(const KeyTrack& track) {
  std::string pairs;
  for_keyframes(track, [&](const Key& key, double time) {
    pairs += fmt::format("{}[{}, {}]", pairs.empty() ? "" : ", ", number(time), value_text(key));
  });
  return fmt::format("[{}]", pairs);
}

std::string write_keyframes(const Keyframes& keyframes) {
  const std::string meaning =
      "values of keys over time, as pairs [time in s, value]; numbers and vectors are interpolated linearly, other values change at the time of a pair";
  if (keyframes.tracks.empty())
    return fmt::format(
        "\n# This scene has no [keyframes]. This table gives {}. Example:\n"
        "#   \"strands.fraction\" = [[0.0, 1.0], [5.0, 0.1]]\n",
        meaning);
  std::string out = fmt::format("\n[keyframes] # {}\n", meaning);
  for (const KeyTrack& track : keyframes.tracks)
    out += fmt::format("{} = {}\n", quoted(track.key), pairs_text(track));
  return out;
}

std::string_view group(std::string_view name) {
  const auto dot = name.rfind('.');
  return dot == std::string_view::npos ? std::string_view{} : name.substr(0, dot);
}

/// Returns the hash of the file's content as 16 hexadecimal digits. If the file cannot be read, returns the
/// file's name without the folder.
std::string content(const std::filesystem::path& path) {
  const std::string hash = path.empty() ? std::string() : hash_of_file(path);
  return hash.empty() ? path.filename().string() : hash;
}

std::string hashed_value(const Key& key) {
  if (const auto* path = std::get_if<std::filesystem::path*>(&key.slot)) return content(**path);
  if (key.name == "model") {
    const std::string& model = *std::get<std::string*>(key.slot);
    if (is_model_file(model)) return content(model);
  }
  return value_text(key);
}

/// Returns the value as TOML. If the value is a path, returns only the name of the file, because a row of
/// results must not contain the folders of the machine.
std::string shown_value(const Key& key) {
  if (const auto* path = std::get_if<std::filesystem::path*>(&key.slot))
    return quoted((*path)->filename().string());
  if (key.name == "model")
    if (const std::string& model = *std::get<std::string*>(key.slot); is_model_file(model))
      return quoted(std::filesystem::path(model).filename().string());
  return value_text(key);
}

/// Returns the list as a TOML array of inline tables.
std::string inline_list(const KeyList& list) {
  std::string out;
  for (std::size_t i = 0; i < list.size(); ++i) {
    std::string entry;
    for (const Key& key : list.keys(i))
      if (!value_text(key).empty())
        entry += fmt::format("{}{} = {}", entry.empty() ? "" : ", ", key.name, shown_value(key));
    out += fmt::format("{}{{ {} }}", out.empty() ? "" : ", ", entry);
  }
  return fmt::format("[{}]", out);
}

/// Longest value in the result of changed_keys(), in bytes. A list of droplets can be much longer.
constexpr std::size_t longest_changed_value = 2000;

}  // namespace

std::string write_scene(const Scene& scene) {
  Scene values = scene;
  Scene defaults;
  const std::vector<Key> keys = scene_keys(values);
  const std::vector<Key> standards = scene_keys(defaults);
  const std::vector<KeyList> lists = scene_lists(values), standard_lists = scene_lists(defaults);
  for (const KeyList& list : standard_lists) list.resize(1);
  std::string out =
      "# A scene of pelage with all keys. Each comment gives the meaning and, in brackets, the range, unit and default.\n"
      "# R is the radius of the model's bounding sphere.\n"
      "# S and W are the papers of Silva et al. 2010 about curling fur and about wet fur. B is the paper of Banisch and Wuethrich 2006.\n";
  std::string_view table;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::string_view name = keys[i].name;
    if (group(name) != table) out += fmt::format("\n[{}]\n", table = group(name));
    out += line(keys[i], name.substr(table.empty() ? 0 : table.size() + 1),
                "; default " + value_text(standards[i]));
    const bool last = i + 1 == keys.size() || group(keys[i + 1].name) != table;
    for (std::size_t n = 0; last && n < lists.size(); ++n)
      if (table == group(lists[n].name))
        out += lists[n].size() > 0 ? write_list(lists[n]) : describe_list(standard_lists[n]);
  }
  return out + write_keyframes(scene.keyframes);
}

std::vector<std::pair<std::string, std::string>> changed_keys(const Scene& scene) {
  Scene values = scene, defaults;
  const std::vector<Key> keys = scene_keys(values), standards = scene_keys(defaults);
  const std::vector<KeyList> lists = scene_lists(values), standard_lists = scene_lists(defaults);
  std::vector<std::pair<std::string, std::string>> changed;
  const auto add = [&](std::string_view name, std::string value, const std::string& standard) {
    if (value == standard) return;
    if (value.size() > longest_changed_value) value = fmt::format("{} characters", value.size());
    changed.emplace_back(name, std::move(value));
  };
  for (std::size_t i = 0; i < keys.size(); ++i)
    add(keys[i].name, shown_value(keys[i]), shown_value(standards[i]));
  for (std::size_t i = 0; i < lists.size(); ++i)
    add(lists[i].name, inline_list(lists[i]), inline_list(standard_lists[i]));
  for (const KeyTrack& track : scene.keyframes.tracks)
    add(fmt::format("keyframes.{}", quoted(track.key)), pairs_text(track), "");
  return changed;
}

std::string scene_hash(const Scene& scene) {
  Scene values = scene;
  std::string all;
  // Rows that were recorded before these keys existed have the default values. Their hashes stay valid,
  // because a default value is not hashed.
  static constexpr std::pair<std::string_view, std::string_view> later_keys[] = {
      {"fur.layer_correction", "\"texel\""},
      {"dynamics.springs.vertices", "\"points\""},
      {"clump.function", "\"logarithmic\""},
      {"shading.self_shadow", "\"darkening\""},
      {"contact.mesh_axis", "[0.0, 1.0, 0.0]"},
      {"contact.mesh_spin", "0.0"},
      {"contact.mesh_frames", "1"},
      {"contact.mesh_after_frames", "\"hold\""},
      {"strands.back_facing", "\"removed\""},
      {"strands.groom", "\"grown\""},
      {"strands.file", "\"\""},
      {"strands.file_unit", "\"R\""},
      {"drag", "1.0"},
      {"damping", "1.0"},
      {"limit", "1.0"},
      {"opacity", "1.0"},
      {"taper", "1.0"},
      {"gloss", "1.0"},
      {"exponent", "1.0"},
      {"rim", "[1.0, 1.0, 1.0]"},
      {"rim_exponent", "1.0"},
      {"skin_shadow", "1.0"},
      {"response_map", "\"\""},
  };
  const auto is_hashed = [](const Key& key) {
    return key.name != "pipeline" && std::ranges::none_of(later_keys, [&](const auto& later) {
             return key.name == later.first && value_text(key) == later.second;
           });
  };
  const auto add = [&](const std::vector<Key>& keys, std::string_view prefix) {
    for (const Key& key : keys)
      if (is_hashed(key)) all += fmt::format("{}{}={}\n", prefix, key.name, hashed_value(key));
  };
  add(scene_keys(values), "");
  for (const KeyList& list : scene_lists(values))
    for (std::size_t i = 0; i < list.size(); ++i) add(list.keys(i), list.name);
  for (const KeyTrack& track : scene.keyframes.tracks)
    for_keyframes(track, [&](const Key& key, double time) {
      all += fmt::format("keyframes.{}@{}={}\n", key.name, number(time), hashed_value(key));
    });
  return Hash().bytes(all.data(), all.size()).hex();
}

}  // namespace pelage
