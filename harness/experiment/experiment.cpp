#include "harness/experiment/experiment.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <re2/re2.h>

#include <algorithm>
#include <random>
#include <set>

#include "harness/base/numbers.hpp"
#include "harness/data_folder.hpp"
#include "harness/error.hpp"
#include "harness/experiment/axes.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/scene/readings.hpp"
#include "harness/scene/scene_keys.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

/// Returns the text as a TOML string; JSON's escape sequences are also valid in TOML.
std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump();
}

/// Returns the scene keys that the value of the axis sets, with their values as TOML text.
std::vector<Setting> settings_of(const std::string& axis, const std::string& value) {
  if (axis == "model") return {{"model", quoted(value)}};
  if (axis == "layers") return {{"fur.layers", value}};
  if (axis == "size") {
    const std::optional<Size> size = size_from_text(value);
    if (!size) throw InputError(fmt::format("size '{}' is not WIDTHxHEIGHT, such as 800x600", value));
    return {{"image.width", std::to_string(size->width)}, {"image.height", std::to_string(size->height)}};
  }
  return {};
}

/// Returns an axis value as a part of a file name: of a mesh file the stem, unless another value of the axis
/// has the same, "0.7_1_0" of the list [0.7, 1, 0], and '_' for all characters except letters, digits, '.'
/// and '_'.
std::string fit_for_a_name(const Axis& axis, const std::string& value) {
  std::string text = value;
  if (axis.key == "model") {
    const auto stem = [](const std::string& name) { return fs::path(name).stem(); };
    const auto same = std::ranges::count_if(
        axis.values, [&](const std::string& other) { return stem(other) == stem(value); });
    text = same > 1 ? fs::path(value).lexically_normal().replace_extension().string() : stem(value).string();
  }
  if (text.starts_with('[')) std::erase_if(text, [](char c) { return c == '[' || c == ']' || c == ' '; });
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '_') c = '_';
  return text;
}

std::vector<Axis> axes_of(const Experiment& experiment, const Preset& preset, const Overrides& overrides) {
  std::vector<Axis> axes = experiment.axes;
  auto replace = [&axes](const Axis& by) {
    const auto found = std::ranges::find_if(axes, [&by](const Axis& a) { return a.key == by.key; });
    if (found == axes.end())
      axes.push_back(by);
    else
      *found = by;
  };
  for (const Axis& axis : preset.axes) replace(axis);
  for (const Axis& axis : overrides.axes) replace(axis);
  if (!overrides.model.empty()) replace({"model", {overrides.model}});
  if (!overrides.reading.empty()) replace({"reading", {overrides.reading}});
  return axes;
}

std::map<std::string, std::string> recorded_of(const Overrides& overrides) {
  std::map<std::string, std::string> result;
  for (const auto& [key, value] : overrides.set) result[key] = value;
  for (const Axis& axis : overrides.axes) result[axis.key] = fmt::format("{}", fmt::join(axis.values, ","));
  if (!overrides.model.empty()) result["model"] = overrides.model;
  return result;
}

// Every case and every row of results contains the values of --set and --axis. This is the largest total size
// of these copies in bytes. Without a limit, 20,000 values of one axis would need 2 GB.
constexpr double most_recorded = 256e6;

void check_recorded(const Experiment& experiment, const std::map<std::string, std::string>& recorded,
                    double cases) {
  double size = 0;
  for (const auto& [key, value] : recorded) size += double(key.size() + value.size());
  if (size * cases > most_recorded)
    throw InputError(fmt::format(
        "{}: each of the {:.0f} cases records the values of --set and --axis, {:.0f} MB in total; the limit is {:.0f} MB. Give the values of long axes in an experiment file",
        experiment.name, cases, size * cases / 1e6, most_recorded / 1e6));
}

/// Returns a scene in which only the keys that choose the pipeline and the paper have the values of the case.
Scene method_of(const Experiment& experiment, const Case& which) {
  Scene scene;
  scene.pipeline = experiment.base.pipeline;
  scene.dynamics.topology = experiment.base.dynamics.topology;
  scene.shading.model = experiment.base.shading.model;
  const auto apply = [&](const std::string& key, const std::string& value) {
    if (key == "pipeline" || key == "dynamics.topology" || key == "shading.model")
      apply_set(scene, fmt::format("{}={}", key, value));
  };
  for (const auto& [key, value] : which.settings) apply(key, value);
  for (const auto& [key, value] : which.set) apply(key, value);
  return scene;
}

bool reads_the_paper(const Case& which) {
  const auto reading = which.axes.find("reading");
  return reading != which.axes.end() && reading->second == "paper";
}

/// Returns the scene keys of a case, with those of `first` behind the experiment's table [scene].
std::map<std::string, std::string> settings_of_case(const Experiment& experiment,
                                                    const std::vector<Axis>& axes, const Case& which,
                                                    const std::vector<ReadingKey>& first) {
  std::map<std::string, std::string> result;
  const auto set = [&result](const Setting& setting) { result[setting.first] = setting.second; };
  for (const Setting& setting : experiment.scene) set(setting);
  for (const ReadingKey& key : first) result[key.name] = key.paper;
  for (const auto& [key, values] : axes)
    if (const auto tables = experiment.at.find(key); tables != experiment.at.end())
      if (const auto found = tables->second.find(which.axes.at(key)); found != tables->second.end())
        for (const Setting& setting : found->second) set(setting);
  // The values of the axes override the scene keys in the tables [AXIS.VALUE], because the scene must have
  // the values that the name of the case states. The only exception is the model. If a table [model.NAME]
  // sets the model to a mesh file, the scene uses this file, and the name of the case contains NAME.
  for (const auto& [key, value] : which.axes)
    for (const Setting& setting : settings_of(key, value))
      if (setting.first != "model" || !table_sets(experiment, "model", value, "model")) set(setting);
  return result;
}

Case make_case(const Experiment& experiment, const std::vector<Axis>& axes,
               const std::vector<std::size_t>& choice, const Overrides& overrides,
               const std::map<std::string, std::string>& recorded) {
  Case result;
  result.variant = default_variant;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto& [key, values] = axes[i];
    const std::string& value = values[choice[i]];
    result.axes[key] = value;
    if (key == "variant") result.variant = value;
    if (is_scene_key(key) && key != "model") result.set.emplace_back(key, value);
    // If the axis is "reading" or "variant", and its value in this case is the axis's first value in the
    // experiment file, the name of the case omits this value.
    const auto own = std::ranges::find_if(experiment.axes, [&k = key](const Axis& a) { return a.key == k; });
    const bool silent = (key == "reading" || key == "variant") && own != experiment.axes.end() &&
                        own->values.front() == value;
    if (!silent) result.name += (result.name.empty() ? "" : "-") + fit_for_a_name(axes[i], value);
  }
  if (result.name.empty()) result.name = experiment.name;  // if the only axes are "reading" and "variant"
  result.settings = settings_of_case(experiment, axes, result, {});
  result.set.insert(result.set.end(), overrides.set.begin(), overrides.set.end());
  result.overrides = recorded;

  const auto variant = experiment.variants.find(result.variant);
  if (variant == experiment.variants.end() && result.variant != default_variant)
    throw InputError(fmt::format("{}: this experiment has no variant '{}'", experiment.name, result.variant));
  auto part = [&](std::string_view key, std::string_view otherwise) {
    if (variant == experiment.variants.end()) return std::string(otherwise);
    const auto found = variant->second.find(std::string(key));
    return found == variant->second.end() ? std::string(otherwise) : found->second;
  };
  const Scene method = method_of(experiment, result);
  result.pipeline = part(pipeline_key, method.pipeline);
  if (variant == experiment.variants.end() && result.pipeline != default_pipeline)
    result.variant = result.pipeline;
  result.mapping = part(mapping_key, "");
  result.opengl = part(opengl_key, "");
  if (reads_the_paper(result))
    result.settings = settings_of_case(experiment, axes, result, reading_of(method, result.pipeline).keys);
  // A relative path on the command line is relative to the working folder. A relative path in the experiment
  // file is relative to the folder of that file.
  if (is_model_file(overrides.model))
    result.settings["model"] = quoted(fs::absolute(overrides.model).lexically_normal().string());

  if (result.overrides.empty()) {
    result.require = experiment.require;
    for (const auto& [key, values] : experiment.require_at)
      if (const auto at = result.axes.find(key); at != result.axes.end())
        if (const auto here = values.find(at->second); here != values.end())
          for (const auto& [metric, least] : here->second) result.require[metric] = least;
    for (const Published& published : experiment.published)
      if (std::ranges::all_of(published.at, [&](const auto& key_value) {
            const auto found = result.axes.find(key_value.first);
            return found != result.axes.end() && canonical(found->second) == canonical(key_value.second);
          }))
        result.published = published.figure;
  }
  return result;
}

}  // namespace

std::string sample_of(std::string_view pipeline) {
  static const std::map<std::string_view, std::string_view> others{
      {"springs", "time steps of a frame"},
      {"springs+baseline", "time steps of a frame"},
      {"springs+rivals", "time steps of a frame"},
      {"springs-error", "one simulated second"},
      {"springs-turns", "one simulated second"},
      {"springs-jacobian", "one simulated second"},
      {"springs-energy", "four simulated seconds"},
      {"springs-drift", "four simulated seconds"},
      {"springs-limit", "search for the longest step"},
      {"springs-shape", "simulation until dynamics.time"}};
  const auto found = others.find(pipeline);
  return std::string(found == others.end() ? "frame" : found->second);
}

Case control_case(const Experiment& experiment, const Case& which) {
  std::vector<Axis> axes;
  for (const Axis& axis : experiment.axes) {
    const std::string& own = which.axes.at(axis.key);
    const bool shipped = axis.key == "reading" && std::ranges::count(reading_names, own) > 0;
    const bool chosen = experiment.baseline.empty() ? is_named(axis.key) && !shipped
                                                    : std::ranges::count(experiment.baseline, axis.key) > 0;
    axes.push_back({axis.key, {chosen ? axis.values.front() : own}});
  }
  for (const auto& [key, value] : which.axes)
    if (std::ranges::none_of(axes, [&k = key](const Axis& axis) { return axis.key == k; }))
      axes.push_back({key, {value}});
  Case result = make_case(experiment, axes, std::vector<std::size_t>(axes.size()), {}, which.overrides);
  result.set = which.set;
  // --model sets the key of the case, not an axis.
  if (const auto model = which.settings.find("model");
      which.overrides.contains("model") && model != which.settings.end())
    result.settings["model"] = model->second;
  return result;
}

const Preset& preset_of(const Experiment& experiment, const std::string& name) {
  const auto found = experiment.presets.find(name);
  if (found != experiment.presets.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [key, preset] : experiment.presets) known.push_back(key);
  throw InputError(
      fmt::format("{} has no preset '{}' (it has: {})", experiment.name, name, fmt::join(known, ", ")));
}

std::vector<Case> cases_of(const Experiment& experiment, const Preset& preset, const Overrides& overrides) {
  const std::vector<Axis> axes = axes_of(experiment, preset, overrides);
  double count = 1;
  for (const Axis& axis : axes) count *= double(axis.values.size());
  if (count > most_cases)
    throw InputError(fmt::format("{}: the axes have {:.0f} combinations of values; the limit is {} cases",
                                 experiment.name, count, most_cases));
  check_axes(experiment, preset, overrides, axes);
  const std::map<std::string, std::string> recorded = recorded_of(overrides);
  check_recorded(experiment, recorded, count);
  std::vector<Case> result;
  std::vector<std::size_t> choice(axes.size());
  for (bool more = true; more;) {
    result.push_back(make_case(experiment, axes, choice, overrides, recorded));
    more = false;
    for (std::size_t i = axes.size(); i-- > 0 && !more;) {
      more = ++choice[i] < axes[i].values.size();
      if (!more) choice[i] = 0;
    }
  }
  std::set<std::string> names;
  for (const Case& c : result) {
    if (c.name.size() > longest_case_name)
      throw InputError(fmt::format(
          "{}: the name of case {}... has {} characters; the limit is {}, because files are named after the case. Use shorter names",
          experiment.name, c.name.substr(0, 40), c.name.size(), longest_case_name));
    if (!names.insert(c.name).second)
      throw InputError(fmt::format("{}: two cases have the name {}", experiment.name, c.name));
  }
  return result;
}

Scene scene_of(const Experiment& experiment, const Case& which) {
  std::string text;
  for (const auto& [key, value] : which.settings) text += fmt::format("{} = {}\n", key, value);
  const std::string source = fmt::format(
      "{} case {}{}", experiment.file.string(), which.name,
      experiment.scene_file.empty() ? "" : fmt::format(" (scene file {})", experiment.scene_file.string()));
  Scene scene = parse_scene(
      text, source, experiment.file.has_parent_path() ? experiment.file.parent_path() : ".", experiment.base);
  for (const auto& [key, value] : which.set)
    apply_set(scene, fmt::format("{}={}", key, value),
              which.axes.contains(key) ? fmt::format("{}: axis {}", experiment.name, key) : "--set");
  if (reads_the_paper(which)) read_lights(scene, reading_of(scene, which.pipeline));
  check_scene(scene, source);
  return scene_at(scene, double(scene.dynamics.time));
}

Filter::Filter(const std::string& expression) {
  re2::RE2::Options options;
  options.set_log_errors(false);
  const auto pattern = std::make_shared<const re2::RE2>(expression, options);
  // The expression may be very long, and RE2's error message quotes the invalid part of it. Both texts are
  // therefore shortened.
  const auto shortened = [](const std::string& text) {
    return text.size() > 80 ? text.substr(0, 80) + "..." : text;
  };
  if (!pattern->ok())
    throw InputError(fmt::format("--filter {}: this is not a valid regular expression: {}",
                                 shortened(expression), shortened(pattern->error())));
  expression_ = pattern;
}

bool Filter::finds(const std::string& name) const {
  return re2::RE2::PartialMatch(name, *expression_);
}

std::vector<Case> filtered(std::vector<Case> cases, const std::string& regex) {
  const Filter filter(regex);
  std::erase_if(cases, [&](const Case& c) { return !filter.finds(c.name); });
  return cases;
}

Shard shard_from_text(const std::string& text) {
  Shard shard{};
  if (RE2::FullMatch(text, "([0-9]{1,6})/([0-9]{1,6})", &shard.index, &shard.count) &&
      shard.index < shard.count)
    return shard;
  throw InputError(fmt::format("--shard '{}' is not i/n with 0 <= i < n, such as 0/4", text));
}

std::vector<Case> shuffled(std::vector<Case> cases, std::uint64_t seed) {
  // Fisher-Yates, because the order of std::shuffle depends on the standard library, and a recorded seed must
  // give the same order everywhere.
  std::mt19937_64 random(seed);
  for (std::size_t i = cases.size(); i > 1; --i) std::swap(cases[i - 1], cases[random() % i]);
  return cases;
}

}  // namespace pelage
