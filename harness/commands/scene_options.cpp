#include "harness/commands/scene_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "harness/base/numbers.hpp"
#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/mesh/read/soup.hpp"
#include "harness/nearest_name.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/scene/pipelines.hpp"
#include "harness/scene/readings.hpp"
#include "harness/scene/scene_keys.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/shells/opencl/shells.hpp"

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

void add_mapping_option(CLI::App& command, std::string& mapping, const std::string& purpose) {
  add_value(command, "--mapping", mapping, "NAME", purpose + ": " + mappings_help())
      ->check(CLI::IsMember(mappings()));
}

void add_up_option(CLI::App& command, std::string& up) {
  command
      .add_option(
          "--up", up,
          "Axis of the mesh file that points up; with z the model is rotated, because y points up in a scene (scene key mesh.up)")
      ->check(CLI::IsMember(choices_of("mesh.up")))
      ->type_name("AXIS");
}

void add_reading_option(CLI::App& command, std::string& reading) {
  command
      .add_option(
          "--reading", reading,
          "paper: the scene's keys as the paper prints them whose method the scene has (docs/glossary.md), with the fewest repairs (readings/*.toml); pelage: the keys as the scene and the defaults have them")
      ->check(CLI::IsMember(std::vector<std::string>(reading_names.begin(), reading_names.end())))
      ->type_name("NAME");
}

void add_scene_options(CLI::App& command, SceneOptions& options, bool draws) {
  add_value(
      command, "scene", options.file, "SCENE",
      "Scene file, or name of an example scene, such as wet-curls; without one, all keys of the scene have their default values");
  add_value(
      command, "--case", options.case_name, "CASE",
      "Use the scene of this case of an experiment; SCENE is then the name of the experiment, or FILE.toml");
  add_value(command, "--set", options.set, "KEY=VALUE", "Override one key of the scene; may be repeated")
      ->allow_extra_args(false);
  add_value(command, "--model", options.model, "MODEL",
            "Model: a name in experiments/models.toml, or a mesh file");
  add_up_option(command, options.up);
  add_reading_option(command, options.reading);
  if (!draws) return;
  add_value(command, "--size", options.size, "WxH", "Size of the picture in pixels");
}

Scene resolve_scene(const SceneOptions& options, std::string_view pipeline) {
  Scene scene;
  if (!options.case_name.empty())
    scene = case_scene(options.file, options.case_name);
  else if (!options.file.empty())
    scene = read_scene(scene_file(options.file));
  if (!options.reading.empty()) {
    // --set overrides keys of the reading, but also says which paper's method draws the scene.
    Scene drawn = scene;
    for (const std::string& assignment : options.set) apply_set(drawn, assignment);
    apply_reading(scene, options.reading, reading_of(drawn, pipeline));
  }
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

namespace {

/// Returns the name of the first backend for which `property` is true.
std::string_view backend_with(bool BackendKind::*property) {
  for (const System* system : systems())
    for (const BackendKind& kind : system->backends)
      if (kind.*property) return kind.name;
  return {};
}

/// Throws InputError if --mapping names a mapping that does not suit the device.
void check_mapping(const std::string& mapping, const System& system, const cl::DeviceInfo& device) {
  const std::vector<std::string> names = system.mappings(device);
  if (!mapping.empty() && std::find(names.begin(), names.end(), mapping) == names.end())
    throw InputError(fmt::format("--mapping {}: on {}, {} can be drawn with {}", mapping, device.name,
                                 system.name, fmt::join(names, ", ")));
}

void warn(const RendererOptions& options, const std::string& text) {
  if (options.strict) throw InputError(fmt::format("--strict: {}", text));
  fmt::print(stderr, "pelage: warning: {}\n", text);
}

}  // namespace

void add_renderer_options(CLI::App& command, RendererOptions& options) {
  command
      .add_option("--pipeline", options.pipeline,
                  fmt::format("{} (default: the scene's key pipeline)", pipelines_help()))
      ->check(CLI::IsMember(choices_of("pipeline")));
  add_value(command, "--opengl", options.opengl, "OPTIONS",
            "Implementation choices of the OpenGL baseline: name=value,name=value (docs/baselines.md)");
  add_mapping_option(
      command, options.mapping,
      "Mapping of pixels to work-items in the pipelines shells and strands (default: depends on the device; strands have tile and group)");
  add_device_option(command, options.device);
  command
      .add_option(
          "--reference-bits", options.bits,
          "8: the reference rounds its picture to 8 bits per channel after every layer, like GPUs of 2010")
      ->check(CLI::IsMember({8, 32}))
      ->capture_default_str();
  command.add_flag(
      "--strict", options.strict,
      "End with status 2 instead of a warning, for instance if the pipeline does not use a key of the scene");
}

const std::string& pipeline_of(const RendererOptions& options, const Scene& scene) {
  return options.pipeline.empty() ? scene.pipeline : options.pipeline;
}

std::unique_ptr<Renderer> open_renderer(const RendererOptions& options, const Scene& scene,
                                        const Scene& shown) {
  const std::string& name = pipeline_of(options, scene);
  const KnownBackend known = backend_named(name);
  if (!known) throw InputError(fmt::format("--pipeline {}: no such pipeline", name));
  if (options.bits == 8 && !known.kind->rounds)
    throw InputError(fmt::format("--reference-bits 8: works only with the reference; add --pipeline {}",
                                 backend_with(&BackendKind::rounds)));
  if (!options.opengl.empty() && !known.kind->has_variants)
    throw InputError(fmt::format("--opengl: works only with the OpenGL baseline; add --pipeline {}",
                                 backend_with(&BackendKind::has_variants)));
  if (const auto ignored = ignored_keys(scene, name); !ignored.empty())
    warn(options, fmt::format("the pipeline {} does not use these keys of the scene: {}", name,
                              fmt::join(ignored, ", ")));
  BackendOptions how{.mapping = options.mapping, .opengl = options.opengl, .bits = options.bits};
  how.few_pictures = true;
  if (known.kind->on_device) {
    how.device = cl::choose_device(options.device);
    check_mapping(options.mapping, *known.system, how.device->info());
  }
  return std::make_unique<Renderer>(known, how, shown);
}

std::shared_ptr<const Mesh> load_drawn_mesh(const RendererOptions& options, const Scene& scene) {
  auto mesh = load_scene_mesh(scene);
  if (const auto warnings = uv_warnings(*mesh); options.strict && !warnings.empty())
    warn(options, fmt::format("{}: {}", mesh->name, fmt::join(warnings, "; ")));
  return mesh;
}

}  // namespace pelage
