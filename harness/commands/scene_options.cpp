#include "harness/commands/scene_options.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "harness/base/numbers.hpp"
#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/mesh/soup.hpp"
#include "harness/nearest_name.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/scene/scene_keys.hpp"
#include "harness/scene/scene_toml.hpp"

namespace fs = std::filesystem;

namespace pelage {
namespace {

/// Sets the picture's width and height from a text such as "800x600". apply_set() checks their ranges.
void set_size(Scene& scene, const std::string& size) {
  const std::optional<Size> pixels = size_from_text(size);
  if (!pixels)
    throw InputError(fmt::format("--size {}: give width x height in pixels, for instance 800x600", size));
  apply_set(scene, fmt::format("image.width={}", pixels->width), "--size");
  apply_set(scene, fmt::format("image.height={}", pixels->height), "--size");
}

/// Returns the path of the scene file. If `name_or_file` is not an existing file and contains no '/', it is
/// the name of an example scene, with or without ".toml". Throws InputError if `name_or_file` has the
/// extension of a mesh file, or if there is no example with this name.
fs::path scene_file(const std::string& name_or_file) {
  if (has_mesh_ending(name_or_file))
    throw InputError(fmt::format(
        "{0}: is a mesh file; give a scene and the mesh, for instance wet-curls --model {0}", name_or_file));
  return file_or_example("", name_or_file);
}

/// Returns the scene of the case `name` of the experiment. Throws InputError if no preset has such a case.
Scene case_scene(const std::string& experiment_name, const std::string& name) {
  if (experiment_name.empty())
    throw InputError(fmt::format("--case {}: give also an experiment, such as silva2010-fig01", name));
  const Experiment experiment = read_experiment(experiment_file(experiment_name));
  std::vector<std::string> known;
  for (const auto& [preset_name, preset] : experiment.presets)
    for (const Case& which : cases_of(experiment, preset)) {
      if (which.name == name) return scene_of(experiment, which);
      known.push_back(which.name);
    }
  const std::string near = nearest_name(name, known);
  throw InputError(fmt::format("--case {}: {} has no such case; {}", name, experiment.name,
                               near.empty()
                                   ? fmt::format("`pelage list {}` prints its cases", experiment.name)
                                   : fmt::format("did you mean {}?", near)));
}

}  // namespace

void add_up_option(CLI::App& command, std::string& up) {
  command
      .add_option(
          "--up", up,
          "Axis of the mesh file that points up; with z the model is rotated, because y points up in a scene (scene key mesh.up)")
      ->check(CLI::IsMember(choices_of("mesh.up")))
      ->type_name("AXIS");
}

void add_scene_options(CLI::App& command, SceneOptions& options, bool draws) {
  command
      .add_option(
          "scene", options.file,
          "Scene file, or name of an example scene, such as wet-curls; without one, all keys of the scene have their default values")
      ->type_name("SCENE");
  command
      .add_option(
          "--case", options.case_name,
          "Use the scene of this case of an experiment; SCENE is then the name of the experiment, or FILE.toml")
      ->type_name("CASE");
  command.add_option("--set", options.set, "Override one key of the scene; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.add_option("--model", options.model, "Model: a name in experiments/models.toml, or a mesh file")
      ->type_name("MODEL");
  add_up_option(command, options.up);
  if (!draws) return;
  command.add_option("--size", options.size, "Size of the picture in pixels")->type_name("WxH");
}

Scene resolve_scene(const SceneOptions& options) {
  Scene scene;
  if (!options.case_name.empty())
    scene = case_scene(options.file, options.case_name);
  else if (!options.file.empty())
    scene = read_scene(scene_file(options.file));
  if (!options.model.empty()) apply_set(scene, "model=" + options.model, "--model");
  if (!options.up.empty()) apply_set(scene, "mesh.up=" + options.up, "--up");
  for (const std::string& assignment : options.set) apply_set(scene, assignment);
  if (!options.size.empty()) set_size(scene, options.size);
  check_scene(scene, options.file.empty() ? "scene" : options.file);
  return scene;
}

std::shared_ptr<const Mesh> load_scene_mesh(const Scene& scene) {
  const auto mesh = load_scene_mesh(scene, [](const std::string& what) { fmt::print(stderr, "{}\n", what); });
  for (const std::string& warning : uv_warnings(*mesh)) fmt::print(stderr, "{}: {}\n", mesh->name, warning);
  return mesh;
}

}  // namespace pelage
