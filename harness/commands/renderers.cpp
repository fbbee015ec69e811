#include "harness/commands/renderers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>

#include "harness/commands/scene_options.hpp"
#include "harness/error.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/scene/pipelines.hpp"
#include "harness/scene/scene_keys.hpp"
#include "harness/shells/opencl/shells.hpp"

namespace pelage {
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
  command
      .add_option("--opengl", options.opengl,
                  "Implementation choices of the OpenGL baseline: name=value,name=value (docs/baselines.md)")
      ->type_name("OPTIONS");
  command
      .add_option(
          "--mapping", options.mapping,
          "Mapping of pixels to work-items in the pipelines shells and strands (default: depends on the device; strands have tile and group): " +
              mappings_help())
      ->check(CLI::IsMember(mappings()))
      ->type_name("NAME");
  command.add_option("--device", options.device, "Device to use: PLATFORM:INDEX, or part of its name")
      ->type_name("DEVICE");
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
