#include "harness/experiment/axes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/base/numbers.hpp"
#include "harness/error.hpp"
#include "harness/scene/readings.hpp"
#include "harness/scene/scene_keys.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {
namespace {

/// Maps each value of an axis to the settings (scene keys and their values) in the table [AXIS.VALUE].
using Tables = std::map<std::string, std::vector<Setting>>;

const Tables& tables_of(const Experiment& experiment, const std::string& axis) {
  static const Tables none;
  const auto found = experiment.at.find(axis);
  return found == experiment.at.end() ? none : found->second;
}

/// Returns the scene keys that the values of the axis set directly, without tables [AXIS.VALUE].
std::vector<std::string> varied_by(const std::string& axis) {
  if (axis == "layers") return {"fur.layers"};
  if (axis == "size") return {"image.width", "image.height"};
  if (is_scene_key(axis)) return {axis};
  return {};
}

/// Checks an axis whose values are names of tables: "reading" or a name of the author's choice.
void check_named(const Experiment& experiment, const Axis& axis) {
  const bool is_reading = axis.key == "reading";
  const auto shipped = [](const std::string& value) {
    return std::ranges::find(reading_names, value) != reading_names.end();
  };
  if (tables_of(experiment, axis.key).empty() && !(is_reading && std::ranges::all_of(axis.values, shipped))) {
    const std::string needed = fmt::format(
        "the file needs a table [{0}.VALUE] with scene keys for at least one value of the axis", axis.key);
    if (is_reading)
      throw InputError(fmt::format("{}: axis reading: for values other than paper and pelage, {}",
                                   experiment.name, needed));
    try {  // apply_set() throws, because the key is unknown; its message suggests the most similar key
      Scene scene;
      apply_set(scene, axis.key + "=0", fmt::format("{}: axis {}", experiment.name, axis.key));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}; if you chose this name for an axis, {}", error.what(), needed));
    }
  }
  std::set<std::string> known = axis_values(experiment, axis.key);
  if (is_reading) known.insert(reading_names.begin(), reading_names.end());
  for (const auto& [value, settings] : tables_of(experiment, axis.key)) known.insert(value);
  for (const std::string& value : axis.values)
    if (!known.contains(value))
      throw InputError(fmt::format("{}: axis {} has no value '{}'; the file has the values {}",
                                   experiment.name, axis.key, value, fmt::join(known, ", ")));
}

void refuse_contradicting_tables(const Experiment& experiment, const Axis& axis, const Axis& other) {
  for (const std::string& value : axis.values)
    for (const std::string& key : varied_by(other.key))
      if (table_sets(experiment, axis.key, value, key))
        throw InputError(fmt::format(
            "{}: the table [{}.{}] sets {}, which the axis {} varies; remove the key from the table, or remove the axis",
            experiment.name, axis.key, value, key, other.key));
}

}  // namespace

bool is_scene_key(const std::string& key) {
  static const std::set<std::string> known = [] {
    std::set<std::string> names;
    Scene scene;
    for (const KeyList& list : scene_lists(scene)) names.emplace(list.name);
    for (const Key& one : scene_keys(scene)) names.emplace(one.name);
    return names;
  }();
  return known.contains(key);
}

bool is_named(const std::string& axis) {
  return axis != "variant" && axis != "layers" && axis != "size" && !is_scene_key(axis);
}

std::string canonical(const std::string& value) {
  const std::optional<double> number = double_of(value);
  return number ? fmt::format("{}", *number) : value;
}

std::set<std::string> axis_values(const Experiment& experiment, const std::string& key) {
  std::set<std::string> values;
  const auto add = [&](const std::vector<Axis>& axes) {
    for (const Axis& axis : axes)
      if (axis.key == key) values.insert(axis.values.begin(), axis.values.end());
  };
  add(experiment.axes);
  for (const auto& [name, preset] : experiment.presets) add(preset.axes);
  return values;
}

bool table_sets(const Experiment& experiment, const std::string& axis, const std::string& value,
                const std::string& key) {
  const Tables& tables = tables_of(experiment, axis);
  const auto settings = tables.find(value);
  return settings != tables.end() &&
         std::ranges::any_of(settings->second, [&](const Setting& setting) { return setting.first == key; });
}

void check_axes(const Experiment& experiment, const Preset& preset, const Overrides& overrides,
                const std::vector<Axis>& axes) {
  const auto in = [](const std::vector<Axis>& list, const std::string& key) {
    return std::ranges::any_of(list, [&](const Axis& axis) { return axis.key == key; });
  };
  std::map<std::string, std::string> varied;  // scene keys and the axes that set them
  for (const Axis& axis : axes) {
    if (is_named(axis.key)) check_named(experiment, axis);
    for (const Axis& other : axes)
      if (other.key != axis.key && !in(overrides.axes, other.key) &&
          (in(experiment.axes, other.key) || in(preset.axes, other.key)))
        refuse_contradicting_tables(experiment, axis, other);
    for (const std::string& key : varied_by(axis.key))
      if (const auto [first, added] = varied.emplace(key, axis.key); !added)
        throw InputError(fmt::format("{}: the axes {} and {} both vary {}; remove one of them",
                                     experiment.name, first->second, axis.key, key));
  }
  for (const auto& [key, value] : overrides.set)
    if (const auto axis = varied.find(key); axis != varied.end())
      throw InputError(
          fmt::format("--set {}: the axis {} of {} varies this key; give the values with --axis {}=...", key,
                      axis->second, experiment.name, axis->second));
}

}  // namespace pelage
