// The table of every key of a scene: what it points to, its unit, range and meaning. Reading, checking,
// writing and documentation all walk this table.
#pragma once
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "harness/scene/scene.hpp"

namespace pelage {

/// Where a key's value lies in the scene at hand.
using Slot = std::variant<float*, int*, std::uint32_t*, bool*, std::string*, std::filesystem::path*,
                          glm::vec3*, std::optional<glm::vec2>*, std::optional<glm::vec3>*>;

struct Key {
  std::string_view name;  ///< dotted, as in a file: "fur.length"
  Slot slot;
  std::string_view unit =
      {};  ///< "" for plain numbers; "direction" for a vector whose length does not matter but is above 0
  double least = -std::numeric_limits<double>::infinity();  ///< inclusive, of every component
  double most = std::numeric_limits<double>::infinity();
  std::string_view help = {};
  std::vector<std::string_view> choices = {};  ///< of a string; empty: any
  bool power_of_two = false;
};

/// Every key but the two lists, in the order in which they are written. Pointers lead into `scene`.
std::vector<Key> scene_keys(Scene& scene);

/// The values that a key of names may have, in their order. Throws InputError for no such key.
std::vector<std::string> choices_of(std::string_view name);

/// Of one entry of [[wetness.droplet]] and of [[shading.light]]; names without the list's own.
std::vector<Key> droplet_keys(DropletScene& droplet);
std::vector<Key> light_keys(LightScene& light);

inline constexpr std::string_view droplet_list = "wetness.droplet";
inline constexpr std::string_view light_list = "shading.light";
inline constexpr std::size_t most_droplets = 100000;
inline constexpr std::size_t most_lights = 2;

/// "R, 0.001 to 1", "\"paper\" or \"uniform\"", "three numbers, each -1 to 1": what a key's value may be.
std::string describe_range(const Key& key);

/// True for a model that is a mesh file rather than a name of models.toml: names hold neither '/' nor '.'.
bool is_model_file(std::string_view model);

}  // namespace pelage
