// The table of all keys of a scene. Each row has a pointer to the value, a unit, a range and a meaning. The
// functions that read, check, write and document scenes iterate over this table.
#pragma once
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "harness/scene/scene.hpp"

namespace pelage {

/// Pointer to a key's value in a scene.
using Slot = std::variant<float*, int*, std::uint32_t*, bool*, std::string*, std::filesystem::path*,
                          glm::vec3*, std::optional<glm::vec2>*, std::optional<glm::vec3>*>;

struct Key {
  std::string_view name;  ///< dotted name of the key, for instance "fur.length"
  Slot slot;
  /// Unit that messages print; "" for a number without unit. "direction" marks a vector of any length above
  /// 0.
  std::string_view unit = {};
  double least = -std::numeric_limits<double>::infinity();  ///< inclusive lower bound of every component
  double most = std::numeric_limits<double>::infinity();
  std::string_view help = {};
  std::vector<std::string_view> choices = {};  ///< permitted values of a string; empty: any string
  bool power_of_two = false;
  bool may_be_empty = false;  ///< permits the empty string, for a string without `choices`
};

inline constexpr double most_seed = 4294967295.0;  ///< largest value of a random seed, 2^32 - 1

/// Returns all keys in the order in which write_scene() writes them, except those of the lists
/// (scene_lists()). Key::slot points into `scene`.
std::vector<Key> scene_keys(Scene& scene);

/// A list of TOML tables in a scene, for instance [[shading.light]].
struct KeyList {
  std::string_view name;            ///< dotted name of the list
  std::string_view entry;           ///< what an entry is, plural, for messages: "lights"
  std::size_t least = 0, most = 0;  ///< permitted number of entries
  std::function<std::size_t()> size;
  std::function<void(std::size_t)> resize;  ///< new entries have default values
  /// Returns the keys of an entry. They have short names without the name of the list: "radius", not
  /// "wetness.droplet.radius". Key::slot points into the scene.
  std::function<std::vector<Key>(std::size_t)> keys;
};

/// Returns all lists. The functions of a KeyList refer to `scene`.
std::vector<KeyList> scene_lists(Scene& scene);

/// Returns the key called `name`; null if there is none.
const Key* find_key(const std::vector<Key>& keys, std::string_view name);

/// Returns the permitted values of the string key `name`, in the order of Key::choices. Throws InputError if
/// no key has this name.
std::vector<std::string> choices_of(std::string_view name);

inline constexpr std::string_view droplet_list = "wetness.droplet";
inline constexpr std::string_view contact_sphere_list = "contact.sphere";
inline constexpr std::string_view contact_capsule_list = "contact.capsule";
inline constexpr std::string_view light_list = "shading.light";
inline constexpr std::string_view strand_layer_list = "strands.layer";
inline constexpr std::string_view strand_fill_list = "strands.fill";

/// Returns the permitted values of a key as text, for instance "0.001 to 1 R" or "three numbers, each -1 to
/// 1".
std::string describe_range(const Key& key);

/// True if `model` is the path of a mesh file. Paths contain '/' or '.'. Names in models.toml contain
/// neither of these characters.
bool is_model_file(std::string_view model);

/// The model of strands without a mesh (strands.groom).
inline constexpr const char* no_model = "none";

/// Returns the keys [strands] and [strands.chain]. Key::slot points into `strands`.
std::vector<Key> strand_keys(StrandsScene& strands);

/// Returns the keys of one entry of [[strands.layer]] or [[strands.fill]], with short names.
std::vector<Key> strand_layer_keys(StrandLayerScene& layer);
std::vector<Key> strand_fill_keys(StrandFillScene& fill);

/// Returns the error text for the value of a key, for instance "7 is out of range; give 2 to 5"; empty if the
/// key permits the value. `values` are the components of one value.
std::string complaint(const Key& key, const std::vector<double>& values);
std::string complaint(const Key& key, const std::string& value);

}  // namespace pelage
