#include "harness/commands/renderers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "harness/error.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/shells/opengl/opengl.hpp"

namespace pelage {
namespace {

DrawPicture open_shells(const RendererOptions& options) {
  ShellOptions shell_options;
  shell_options.mapping = options.mapping;
  return [device = cl::choose_device(options.device),
          shell_options](const std::shared_ptr<const FrameInput>& input) -> FrameOutput {
    Shells shells(device, input, shell_options);
    shells.advance(frames_before(input->scene.dynamics));
    const FrameTiming timing = shells.frame();
    fmt::print(stderr,
               "{}: {:.1f} ms for the first frame, without warm-up; use `pelage run` to time frames\n",
               device.info().name, timing.wall_ms);
    return {fmt::format("shells on {}", device.info().name),
            shells.frames_simulated(),
            shells.tips(),
            shells.velocities(),
            shells.mask(),
            shells.read()};
  };
}

DrawPicture open_reference(const RendererOptions& options) {
  return [eight_bits = options.bits == 8](const std::shared_ptr<const FrameInput>& input) {
    return reference_output(*input, frames_before(input->scene.dynamics) + 1, eight_bits);
  };
}

DrawPicture open_opengl(const RendererOptions& given) {
  return [options = opengl_options(given.opengl),
          renderer = opengl_renderer()](const std::shared_ptr<const FrameInput>& input) {
    FrameOutput output = reference_motion(*input, frames_before(input->scene.dynamics) + 1);
    OpenGl opengl(input, output.mask, options);
    opengl.bend(output.tips);
    fmt::print(stderr, "{}: {:.1f} ms for the first frame, without warm-up\n", renderer, opengl.frame());
    output.pipeline = fmt::format("opengl on {}, {}", renderer, to_text(options));
    output.image = opengl.read();
    return output;
  };
}

constexpr Renderer table[] = {
    {"shells", "OpenCL", false, false, open_shells},
    {"reference", "naive implementation in double precision on the host", true, false, open_reference},
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

DrawPicture open_renderer(const RendererOptions& options) {
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
  return chosen->open(options);
}

}  // namespace pelage
