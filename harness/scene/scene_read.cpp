#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <fstream>

#include "harness/base/toml_file.hpp"
#include "harness/error.hpp"
#include "harness/nearest_name.hpp"
#include "harness/scene/scene_keys.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = 1 << 20;  // greatest size of a scene file, 1 MiB

/// Source of a scene's text. Contains the name for error texts, the folder against which relative paths are
/// resolved, and whether error texts contain line numbers.
struct Source {
  std::string name;
  fs::path folder;
  bool lines = true;
};

[[noreturn]] void refuse(const Source& source, const toml::node* node, std::string_view key,
                         std::string_view what) {
  std::string where = source.name;
  if (source.lines && node && node->source().begin.line > 0)
    where += fmt::format(":{}", node->source().begin.line);
  throw InputError(fmt::format("{}: {}: {}", where, key, what));
}

std::string_view kind(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a truth value";
    default:
      return "a date or time";
  }
}

std::string_view leaf(std::string_view name) {
  return name.substr(name.rfind('.') + 1);
}

/// All keys and lists of a scene, and the keyframes of its keys.
struct Keys {
  std::vector<Key> keys;
  std::vector<KeyList> lists;
  Keyframes& keyframes;

  explicit Keys(Scene& scene)
      : keys(scene_keys(scene)), lists(scene_lists(scene)), keyframes(scene.keyframes) {}

  /// Removes the keyframes of the key. A value that overrides a key applies at all times.
  void make_constant(std::string_view key) const {
    std::erase_if(keyframes.tracks, [key](const KeyTrack& track) { return track.key == key; });
  }
};

/// Returns the error text for an unknown key. The text suggests the key or the list with the smallest edit
/// distance from `wanted` if this distance is below a limit.
std::string unknown(std::string_view wanted, const std::vector<Key>& keys,
                    const std::vector<KeyList>& lists) {
  std::vector<std::string_view> names;
  names.reserve(keys.size() + lists.size());
  for (const Key& key : keys) names.push_back(key.name);
  for (const KeyList& list : lists) names.push_back(list.name);
  std::string_view best;
  std::size_t least = std::max<std::size_t>(2, std::min<std::size_t>(wanted.size(), 40) / 3) + 1;
  if (wanted.size() < 100) {
    for (const std::string_view name : names) {
      // The first edit distance is that of the full names. The second edit distance is that of the parts
      // after the last dot, because users may write a key in a wrong TOML table or in no table.
      const std::size_t here =
          std::min(edit_distance(wanted, name), edit_distance(leaf(wanted), leaf(name)) + 1);
      if (here < least) least = here, best = name;
    }
  }
  if (best.empty()) return "no such key; `pelage scene` prints all keys";
  return fmt::format("no such key; did you mean {}?", best);
}

double number_from(const Source& source, const toml::node& node, const Key& key, std::string_view name) {
  if (const auto* whole = node.as_integer()) return static_cast<double>(whole->get());
  const bool wants_whole =
      std::holds_alternative<int*>(key.slot) || std::holds_alternative<std::uint32_t*>(key.slot);
  const auto* real = node.as_floating_point();
  if (!real || wants_whole)
    refuse(source, &node, name, fmt::format("is {}; give {}", kind(node), describe_range(key)));
  return real->get();
}

std::vector<double> vector(const Source& source, const toml::node& node, const Key& key,
                           std::string_view name, std::size_t size) {
  const auto* array = node.as_array();
  if (!array) refuse(source, &node, name, fmt::format("is {}; give {}", kind(node), describe_range(key)));
  if (array->size() != size)
    refuse(source, &node, name, fmt::format("has {} entries; give {}", array->size(), describe_range(key)));
  std::vector<double> values;
  for (const toml::node& entry : *array) values.push_back(number_from(source, entry, key, name));
  return values;
}

std::string string(const Source& source, const toml::node& node, const Key& key, std::string_view name) {
  const auto* text = node.as_string();
  if (!text) refuse(source, &node, name, fmt::format("is {}; give {}", kind(node), describe_range(key)));
  return text->get();
}

/// Returns an absolute path. Resolves a relative path against the folder of the source. A scene with absolute
/// paths can be used from any working directory.
std::string from_folder(const Source& source, const std::string& path) {
  if (path.empty()) return path;
  return fs::absolute(source.folder / path).lexically_normal().string();
}

void assign(const Source& source, const toml::node& node, const Key& key, const std::string& name) {
  const auto checked = [&](auto value) {
    if (const std::string wrong = complaint(key, value); !wrong.empty()) refuse(source, &node, name, wrong);
    return value;
  };
  const auto reals = [&](std::size_t size) { return checked(vector(source, node, key, name, size)); };
  const auto real = [&] { return checked(std::vector<double>{number_from(source, node, key, name)})[0]; };
  std::visit(
      [&](auto* slot) {
        using T = std::remove_reference_t<decltype(*slot)>;
        if constexpr (std::is_same_v<T, bool>) {
          if (!node.is_boolean())
            refuse(source, &node, name, fmt::format("is {}; give true or false", kind(node)));
          *slot = node.as_boolean()->get();
        } else if constexpr (std::is_same_v<T, std::string>) {
          *slot = checked(string(source, node, key, name));
          if (key.name == "model" && is_model_file(*slot)) *slot = from_folder(source, *slot);
        } else if constexpr (std::is_same_v<T, fs::path>) {
          *slot = from_folder(source, string(source, node, key, name));
        } else if constexpr (std::is_same_v<T, std::optional<glm::vec2>>) {
          const auto values = reals(2);
          *slot = glm::vec2(values[0], values[1]);
        } else if constexpr (std::is_same_v<T, glm::vec3> || std::is_same_v<T, std::optional<glm::vec3>>) {
          const auto values = reals(3);
          *slot = glm::vec3(values[0], values[1], values[2]);
        } else {
          *slot = static_cast<T>(real());
        }
      },
      key.slot);
}

/// Reads a list of tables, for instance [[shading.light]].
void read_list(const Source& source, const toml::node& node, const KeyList& list) {
  const auto* array = node.as_array();
  if (!array)
    refuse(source, &node, list.name, fmt::format("is {}; give [[{}]] entries", kind(node), list.name));
  list.resize(0);
  list.resize(array->size());
  for (std::size_t i = 0; i < array->size(); ++i) {
    const std::string here = fmt::format("{}[{}]", list.name, i + 1);
    const toml::node& element = (*array)[i];
    const auto* table = element.as_table();
    if (!table)
      refuse(source, &element, here, fmt::format("is {}; give [[{}]] entries", kind(element), list.name));
    const std::vector<Key> keys = list.keys(i);
    for (const auto& [word, value] : *table) {
      const Key* key = find_key(keys, word.str());
      const std::string full = fmt::format("{}.{}", here, word.str());
      if (!key) refuse(source, &value, full, unknown(word.str(), keys, {}));
      assign(source, value, *key, full);
    }
  }
}

/// Reads the key or the list `name` from `node`. Returns false if no key and no list has this name.
bool read_key(const Keys& known, const Source& source, const toml::node& node, const std::string& name) {
  for (const KeyList& list : known.lists)
    if (name == list.name) {
      read_list(source, node, list);
      return true;
    }
  const Key* key = find_key(known.keys, name);
  if (!key) return false;
  known.make_constant(name);
  assign(source, node, *key, name);
  return true;
}

void read_table(const Keys& known, const Source& source, const toml::table& table,
                const std::string& prefix) {
  for (const auto& [word, node] : table) {
    const std::string name = prefix + std::string(word.str());
    if (name == "keyframes") continue;  // read_keyframes() reads this table
    const bool group = std::any_of(known.keys.begin(), known.keys.end(),
                                   [&](const Key& k) { return k.name.starts_with(name + "."); });
    if (group) {
      if (!node.is_table())
        refuse(source, &node, name, fmt::format("is {}; give a TOML table [{}] with keys", kind(node), name));
      read_table(known, source, *node.as_table(), name + ".");
    } else if (!read_key(known, source, node, name)) {
      refuse(source, &node, name, unknown(name, known.keys, known.lists));
    }
  }
}

/// Reads the keyframes of one key: an array of pairs [time, value]. `name` is the key in messages.
KeyTrack read_track(const Source& source, const toml::node& node, const Key& key, const std::string& name) {
  const std::string wanted =
      fmt::format("give pairs [time in s, value], where the value is {}", describe_range(key));
  const auto* pairs = node.as_array();
  if (!pairs) refuse(source, &node, name, fmt::format("is {}; {}", kind(node), wanted));
  if (pairs->empty() || pairs->size() > most_keyframes)
    refuse(source, &node, name, fmt::format("has {} keyframes; give 1 to {}", pairs->size(), most_keyframes));
  KeyTrack track{std::string(key.name), {}};
  for (std::size_t i = 0; i < pairs->size(); ++i) {
    const toml::node& entry = (*pairs)[i];
    const std::string here = fmt::format("{}[{}]", name, i + 1);
    const auto* pair = entry.as_array();
    if (!pair) refuse(source, &entry, here, fmt::format("is {}; {}", kind(entry), wanted));
    if (pair->size() != 2)
      refuse(source, &entry, here, fmt::format("has {} entries; {}", pair->size(), wanted));
    const toml::node& when = (*pair)[0];
    if (!when.is_number()) refuse(source, &when, here, fmt::format("its time is {}; {}", kind(when), wanted));
    const double time = *when.value<double>();
    if (!(time >= 0 && time <= most_keyframe_time))
      refuse(source, &when, here,
             fmt::format("the time {} s is out of range; give 0 to {} s", time, most_keyframe_time));
    if (i > 0 && !(time > track.frames.back().time))
      refuse(source, &when, here,
             fmt::format("the time {} s is not after {} s; give ascending times", time,
                         track.frames.back().time));
    assign(source, (*pair)[1], key, here);
    track.frames.push_back({time, key_value(key)});
  }
  return track;
}

/// Reads the table [keyframes]. Its keys are dotted names of scene keys, quoted or not.
void read_keyframes(const Source& source, const toml::node& node, const std::string& prefix, Scene& scene) {
  const auto* table = node.as_table();
  if (!table)
    refuse(source, &node, "keyframes", fmt::format("is {}; give a TOML table [keyframes]", kind(node)));
  Scene scratch;
  const std::vector<Key> keys = scene_keys(scratch);
  for (const auto& [word, value] : *table) {
    const std::string name = prefix + std::string(word.str()), full = fmt::format("keyframes.\"{}\"", name);
    if (value.is_table()) {
      read_keyframes(source, value, name + ".", scene);
      continue;
    }
    const Key* key = find_key(keys, name);
    if (!key) refuse(source, &value, full, unknown(name, keys, {}));
    if (!may_have_keyframes(*key)) refuse(source, &value, full, "this key cannot change over time");
    KeyTrack track = read_track(source, value, *key, full);
    std::vector<KeyTrack>& tracks = scene.keyframes.tracks;
    std::erase_if(tracks, [&](const KeyTrack& other) { return other.key == name; });
    tracks.push_back(std::move(track));
    std::sort(tracks.begin(), tracks.end(),
              [](const KeyTrack& left, const KeyTrack& right) { return left.key < right.key; });
  }
}

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name, const fs::path& folder, const Scene& base) {
  Scene scene = base;
  const toml::table table = parse_toml(std::string(text), name);
  for (const char* key : {"axes", "preset"})
    if (const toml::node* node = table.get(key); node && node->is_table())
      throw InputError(fmt::format(
          "{}:{}: [{}] is a table of an experiment file, not of a scene; `pelage run {}` runs an experiment",
          name, node->source().begin.line, key, name));
  // The keys are read first, because a key of this text removes the keyframes that the base has for it.
  read_table(Keys(scene), Source{name, folder}, table, "");
  if (const toml::node* keyframes = table.get("keyframes"))
    read_keyframes(Source{name, folder}, *keyframes, "", scene);
  check_scene(scene, name);
  return scene;
}

Scene read_scene(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error))
    throw InputError(
        fmt::format("{}: {}", path.string(), error ? error.message() : "there is no such scene file"));
  if (fs::is_directory(path, error))
    throw InputError(fmt::format("{}: is a folder; give a scene file", path.string()));
  std::ifstream file(path, std::ios::binary);
  std::string text(most_bytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad() || !(file.eof() || file.good()))
    throw InputError(fmt::format("{}: cannot be read", path.string()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > most_bytes) {
    throw InputError(fmt::format("{}: is larger than a scene file may be; give at most {} bytes",
                                 path.string(), most_bytes));
  }
  return parse_scene(text, path.string(), path.parent_path());
}

void apply_set(Scene& scene, std::string_view assignment, const std::string& source_name) {
  const auto equals = assignment.find('=');
  const std::string name = trimmed(assignment.substr(0, equals));
  if (equals == std::string_view::npos || name.empty()) {
    throw InputError(
        fmt::format("{} {}: give key=value, for instance fur.length=0.1", source_name, assignment));
  }
  const std::string value = trimmed(assignment.substr(equals + 1));
  const Source source{source_name, ".", false};
  const Keys known(scene);
  const std::vector<Key>& keys = known.keys;
  const Key* key = find_key(keys, name);
  const bool is_list = std::any_of(known.lists.begin(), known.lists.end(),
                                   [&](const KeyList& list) { return list.name == name; });
  if (!key && !is_list) refuse(source, nullptr, name, unknown(name, keys, known.lists));
  const bool words = key && (std::holds_alternative<std::string*>(key->slot) ||
                             std::holds_alternative<fs::path*>(key->slot));
  if (words && (value.empty() || (value[0] != '"' && value[0] != '\''))) {
    known.make_constant(name);
    assign(source, toml::value<std::string>(value), *key, name);
    return;
  }
  const std::string wanted = key ? describe_range(*key) : "an array of tables";
  try {
    const std::string line = "value = " + value;
    check_toml_text(line, fmt::format("{}: {}", source_name, name));
    const toml::table table = toml::parse(line);
    if (table.size() != 1) throw InputError(fmt::format("{}: {}: give one value", source_name, name));
    read_key(known, source, *table.get("value"), name);
  } catch (const toml::parse_error&) {
    refuse(source, nullptr, name, fmt::format("'{}' is no TOML value; give {}", value, wanted));
  }
}

}  // namespace pelage
