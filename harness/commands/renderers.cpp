#include "harness/commands/renderers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "harness/cl/build_ahead.hpp"
#include "harness/compare/frame_output.hpp"
#include "harness/compare/strands.hpp"
#include "harness/dump/dump.hpp"
#include "harness/dump/strands.hpp"
#include "harness/error.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/shells/opengl/opengl.hpp"
#include "harness/strands/opencl/program_texts.hpp"
#include "harness/strands/opencl/strands.hpp"
#include "harness/subjects/raycast_difference.hpp"

namespace pelage {
namespace {

void report_first_frame(const std::string& device, double ms) {
  fmt::print(stderr, "{}: {:.1f} ms for the first frame, without warm-up; use `pelage run` to time frames\n",
             device, ms);
}

/// Returns the picture of `output`, and the function that dumps it.
DrawnFrame drawn(std::shared_ptr<const FrameInput> input, FrameOutput output) {
  DrawnFrame frame{output.image, {}};
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

DrawPicture open_shells(const RendererOptions& options, const Scene& scene) {
  ShellOptions shell_options;
  shell_options.mapping = options.mapping;
  return [device = cl::choose_device(options.device), shell_options,
          scene](const std::shared_ptr<const Mesh>& mesh) {
    const auto input = prepare(scene, mesh);
    Shells shells(device, input, shell_options);
    shells.advance(frames_before(scene.dynamics));
    report_first_frame(device.info().name, shells.frame().wall_ms);
    return drawn(input,
                 FrameOutput{fmt::format("shells on {}", device.info().name), shells.frames_simulated(),
                             shells.tips(), shells.velocities(), shells.mask(), shells.read()});
  };
}

DrawPicture open_reference(const RendererOptions& options, const Scene& scene) {
  return [eight_bits = options.bits == 8, scene](const std::shared_ptr<const Mesh>& mesh) {
    const auto input = prepare(scene, mesh);
    return drawn(input, reference_output(*input, frames_before(scene.dynamics) + 1, eight_bits));
  };
}

DrawPicture open_opengl(const RendererOptions& given, const Scene& scene) {
  return [options = opengl_options(given.opengl), renderer = opengl_renderer(),
          scene](const std::shared_ptr<const Mesh>& mesh) {
    const auto input = prepare(scene, mesh);
    FrameOutput output = reference_motion(*input, frames_before(scene.dynamics) + 1);
    OpenGl opengl(input, output.mask, options);
    opengl.bend(output.tips);
    report_first_frame(renderer, opengl.frame());
    output.pipeline = fmt::format("opengl on {}, {}", renderer, to_text(options));
    output.image = opengl.read();
    return drawn(input, std::move(output));
  };
}

DrawPicture open_strands(const RendererOptions& options, const Scene& scene) {
  strands::DrawerOptions drawer;
  drawer.mapping = strands::drawing_named(options.mapping);
  const cl::Device device = cl::choose_device(options.device);
  auto ahead = std::make_shared<cl::BuildAhead>(device, strands::expected_programs(device, scene, drawer));
  return [device, drawer, scene, ahead](const std::shared_ptr<const Mesh>& mesh) {
    const auto input = strands::prepare_strands(scene, mesh);
    const auto drawn = std::make_shared<strands::Strands>(device, input, drawer);
    drawn->advance(frames_before(scene.dynamics));
    report_first_frame(device.info().name, drawn->frame().wall_ms);
    DrawnFrame frame{drawn->read(), {}};
    frame.dump = [input, drawn, image = frame.image,
                  name = device.info().name](const std::filesystem::path& path) {
      StrandFrame arrays{drawn->keys(), {}, drawn->order(), image};
      arrays.curves = drawn->curves();
      arrays.skin = drawn->surface();
      dump_strands(path, *input, arrays, fmt::format("strands on {}", name), drawn->frames_simulated());
    };
    return frame;
  };
}

DrawPicture open_strands_reference(const RendererOptions&, const Scene& scene) {
  return [scene](const std::shared_ptr<const Mesh>& mesh) {
    const auto input = strands::prepare_strands(scene, mesh);
    const int frames = frames_before(scene.dynamics) + 1;
    return drawn(input, reference_strands(*input, frames), "strands-reference", frames);
  };
}

DrawPicture open_strands_raycast(const RendererOptions&, const Scene& scene) {
  return [scene](const std::shared_ptr<const Mesh>& mesh) {
    const auto input = strands::prepare_strands(scene, mesh);
    StrandFrame frame{
        input->fur.keys, reference_curves(*input, input->fur.keys), {}, raycast_strands(*input).picture};
    return drawn(input, std::move(frame), "strands-raycast", 0);
  };
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

}  // namespace

std::span<const Renderer> renderers() {
  return table;
}

DrawPicture open_renderer(const RendererOptions& options, const Scene& scene) {
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

}  // namespace pelage
