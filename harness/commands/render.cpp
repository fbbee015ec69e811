#include "harness/commands/render.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>

#include "harness/commands/scene_options.hpp"
#include "harness/dump/dump.hpp"
#include "harness/error.hpp"
#include "harness/picture/image_io.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/shells/opengl/opengl.hpp"

namespace pelage {
namespace {

struct RenderOptions {
  SceneOptions scene;
  std::string output, dump, device;
  std::string pipeline = "shells", mapping, opengl;
  int bits = 32;
};

FrameOutput shells_output(const RenderOptions& options, const cl::Device& device,
                          const std::shared_ptr<const FrameInput>& input) {
  ShellOptions shell_options;
  shell_options.mapping = options.mapping;
  Shells shells(device, input, shell_options);
  shells.advance(frames_before(input->scene.dynamics));
  const FrameTiming timing = shells.frame();
  fmt::print(stderr, "{}: {:.1f} ms for the first frame, without warm-up; use `pelage run` to time frames\n",
             device.info().name, timing.wall_ms);
  return {fmt::format("shells on {}", device.info().name),
          shells.frames_simulated(),
          shells.tips(),
          shells.velocities(),
          shells.mask(),
          shells.read()};
}

FrameOutput opengl_output(const OpenGlOptions& options, const std::string& renderer,
                          const std::shared_ptr<const FrameInput>& input) {
  FrameOutput output = reference_motion(*input, frames_before(input->scene.dynamics) + 1);
  OpenGl opengl(input, output.mask, options);
  opengl.bend(output.tips);
  fmt::print(stderr, "{}: {:.1f} ms for the first frame, without warm-up\n", renderer, opengl.frame());
  output.pipeline = fmt::format("opengl on {}, {}", renderer, to_text(options));
  output.image = opengl.read();
  return output;
}

int render(const RenderOptions& options) {
  if (options.bits == 8 && options.pipeline != "reference") {
    throw InputError("--reference-bits 8: works only with the reference; add --pipeline reference");
  }
  if (!options.opengl.empty() && options.pipeline != "opengl") {
    throw InputError("--opengl: works only with the OpenGL baseline; add --pipeline opengl");
  }
  check_picture_path(options.output);
  if (!options.dump.empty()) check_dump_path(options.dump);
  const Scene scene = resolve_scene(options.scene);
  const bool shells = options.pipeline == "shells";
  // The device is chosen before the mesh is prepared, which may take minutes, so that a wrong name fails at
  // once.
  std::optional<cl::Device> device;
  if (shells) device = cl::choose_device(options.device);
  const bool opengl = options.pipeline == "opengl";
  const std::string renderer = opengl ? opengl_renderer() : "";
  const OpenGlOptions opengl_choice = opengl ? opengl_options(options.opengl) : OpenGlOptions{};
  const auto input = prepare(scene, load_scene_mesh(scene));
  const FrameOutput output =
      shells   ? shells_output(options, *device, input)
      : opengl ? opengl_output(opengl_choice, renderer, input)
               : reference_output(*input, frames_before(scene.dynamics) + 1, options.bits == 8);
  write_picture(options.output, output.image);
  if (!options.dump.empty()) dump_frame(options.dump, *input, output);
  return 0;
}

}  // namespace

void add_render(CLI::App& app, Chosen& chosen) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Draw one picture of a scene");
  add_scene_options(*command, options->scene, true);
  command->add_option("-o,--output", options->output, "Picture to write: .png (8-bit), .exr or .tif (float)")
      ->required()
      ->type_name("IMAGE");
  command
      ->add_option("--pipeline", options->pipeline,
                   "shells: OpenCL; reference: naive implementation in double precision on the host; opengl: "
                   "the paper's "
                   "own pipeline of N passes on the installed OpenGL")
      ->check(CLI::IsMember({"shells", "reference", "opengl"}))
      ->capture_default_str();
  command
      ->add_option("--opengl", options->opengl,
                   "Implementation choices of the OpenGL baseline: name=value,name=value (docs/rival.md)")
      ->type_name("OPTIONS");
  command
      ->add_option(
          "--mapping", options->mapping,
          "Mapping of the shells' pixels to work-items (default: depends on the device): " + mappings_help())
      ->check(CLI::IsMember(mappings()))
      ->type_name("NAME");
  command->add_option("--device", options->device, "Device to use: PLATFORM:INDEX, or part of its name")
      ->type_name("DEVICE");
  command
      ->add_option("--dump", options->dump, "Write all inputs and intermediate arrays of the frame as HDF5")
      ->type_name("FRAME.h5");
  command
      ->add_option(
          "--reference-bits", options->bits,
          "8: the reference rounds its picture to 8 bits per channel after every layer, like GPUs of 2010")
      ->check(CLI::IsMember({8, 32}))
      ->capture_default_str();
  command->callback([options, &chosen] { chosen = [options] { return render(*options); }; });
}

}  // namespace pelage
