#include "harness/commands/renderers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "harness/commands/opencl_renderers.hpp"
#include "harness/compare/frame_output.hpp"
#include "harness/compare/strands.hpp"
#include "harness/dump/dump.hpp"
#include "harness/dump/strands.hpp"
#include "harness/error.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/shells/opengl/opengl.hpp"
#include "harness/subjects/raycast_difference.hpp"

namespace pelage {
namespace {

using Draw = std::function<DrawnFrame(const Scene&, const std::shared_ptr<const Mesh>&)>;

/// A renderer that keeps nothing from one picture to the next.
class FreshRenderer : public SceneRenderer {
 public:
  explicit FreshRenderer(Draw draw, std::string device = {})
      : draw_(std::move(draw)), device_(std::move(device)) {}
  DrawnFrame draw(const Scene& scene, const std::shared_ptr<const Mesh>& mesh) override {
    return draw_(scene, mesh);
  }
  std::string device() const override { return device_; }

 private:
  Draw draw_;
  std::string device_;
};

/// Returns the picture of `output`, and the function that dumps it.
DrawnFrame drawn(std::shared_ptr<const FrameInput> input, FrameOutput output, double ms = 0) {
  DrawnFrame frame{output.image, {}, ms};
  frame.dump = [input = std::move(input), output = std::move(output)](const std::filesystem::path& path) {
    dump_frame(path, *input, output);
  };
  return frame;
}

/// Returns the picture of `frame`, and the function that dumps it.
DrawnFrame drawn(std::shared_ptr<const strands::StrandInput> input, StrandFrame frame, std::string pipeline,
                 int frames) {
  DrawnFrame result{frame.picture, {}};
  result.dump = [input = std::move(input), frame = std::move(frame), pipeline = std::move(pipeline),
                 frames](const std::filesystem::path& path) {
    dump_strands(path, *input, frame, pipeline, frames);
  };
  return result;
}

std::unique_ptr<SceneRenderer> open_reference(const RendererOptions& options, const Scene&) {
  return std::make_unique<FreshRenderer>(
      [eight_bits = options.bits == 8](const Scene& scene, const std::shared_ptr<const Mesh>& mesh) {
        const auto input = prepare(scene, mesh);
        return drawn(input, reference_output(*input, frames_before(scene.dynamics) + 1, eight_bits));
      });
}

std::unique_ptr<SceneRenderer> open_opengl(const RendererOptions& given, const Scene&) {
  const std::string renderer = opengl_renderer();
  return std::make_unique<FreshRenderer>(
      [options = opengl_options(given.opengl), renderer](const Scene& scene,
                                                         const std::shared_ptr<const Mesh>& mesh) {
        const auto input = prepare(scene, mesh);
        FrameOutput output = reference_motion(*input, frames_before(scene.dynamics) + 1);
        OpenGl opengl(input, output.mask, options);
        opengl.bend(output.tips, output.frames);
        const double ms = opengl.frame();
        output.pipeline = fmt::format("opengl on {}, {}", renderer, to_text(options));
        output.image = opengl.read();
        return drawn(input, std::move(output), ms);
      },
      renderer);
}

std::unique_ptr<SceneRenderer> open_strands_reference(const RendererOptions&, const Scene&) {
  return std::make_unique<FreshRenderer>([](const Scene& scene, const std::shared_ptr<const Mesh>& mesh) {
    const auto input = strands::prepare_strands(scene, mesh);
    const int frames = frames_before(scene.dynamics) + 1;
    return drawn(input, reference_strands(*input, frames), "strands-reference", frames);
  });
}

std::unique_ptr<SceneRenderer> open_strands_raycast(const RendererOptions&, const Scene&) {
  return std::make_unique<FreshRenderer>([](const Scene& scene, const std::shared_ptr<const Mesh>& mesh) {
    const auto input = strands::prepare_strands(scene, mesh);
    StrandFrame frame{
        input->fur.keys, reference_curves(*input, input->fur.keys), {}, raycast_strands(*input).picture};
    return drawn(input, std::move(frame), "strands-raycast", 0);
  });
}

constexpr Renderer table[] = {
    {"shells", "OpenCL", false, false, open_shells},
    {"reference", "naive implementation in double precision on the host", true, false, open_reference},
    {"strands", "single strands instead of layers, on OpenCL (docs/strands.md)", false, false, open_strands},
    {"strands-reference", "naive implementation of strands in double precision on the host", false, false,
     open_strands_reference},
    {"strands-raycast", "strands at rest as cones, ray-cast, without shadows of strands", false, false,
     open_strands_raycast},
    {"opengl", "the pipeline of Silva et al. (2010) in OpenGL, with one pass per layer", false, true,
     open_opengl},
};

/// Returns the name of the first pipeline for which `property` is true.
std::string_view pipeline_with(bool Renderer::*property) {
  return std::find_if(std::begin(table), std::end(table), [&](const Renderer& r) { return r.*property; })
      ->name;
}

std::vector<std::string> renderer_names() {
  std::vector<std::string> names;
  for (const Renderer& renderer : table) names.emplace_back(renderer.name);
  return names;
}

std::string renderers_help() {
  std::string text;
  for (const Renderer& renderer : table)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", renderer.name, renderer.what);
  return text;
}

}  // namespace

std::span<const Renderer> renderers() {
  return table;
}

void add_renderer_options(CLI::App& command, RendererOptions& options) {
  command.add_option("--pipeline", options.pipeline, renderers_help())
      ->check(CLI::IsMember(renderer_names()))
      ->capture_default_str();
  command
      .add_option("--opengl", options.opengl,
                  "Implementation choices of the OpenGL baseline: name=value,name=value (docs/baselines.md)")
      ->type_name("OPTIONS");
  command
      .add_option(
          "--mapping", options.mapping,
          "Mapping of pixels to work-items in the pipelines shells and strands (default: depends on the "
          "device; strands have tile and group): " +
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
}

std::unique_ptr<SceneRenderer> open_renderer(const RendererOptions& options, const Scene& scene) {
  const auto chosen = std::find_if(std::begin(table), std::end(table),
                                   [&](const Renderer& r) { return r.name == options.pipeline; });
  if (chosen == std::end(table))
    throw InputError(fmt::format("--pipeline {}: no such pipeline", options.pipeline));
  if (options.bits == 8 && !chosen->rounds)
    throw InputError(fmt::format("--reference-bits 8: works only with the reference; add --pipeline {}",
                                 pipeline_with(&Renderer::rounds)));
  if (!options.opengl.empty() && !chosen->has_variants)
    throw InputError(fmt::format("--opengl: works only with the OpenGL baseline; add --pipeline {}",
                                 pipeline_with(&Renderer::has_variants)));
  return chosen->open(options, scene);
}

void report_first_frame(const SceneRenderer& renderer, const DrawnFrame& frame) {
  if (frame.ms <= 0) return;
  fmt::print(stderr, "{}: {:.1f} ms for the first frame, without warm-up; use `pelage run` to time frames\n",
             renderer.device(), frame.ms);
}

}  // namespace pelage
