#include "harness/commands/render.hpp"

#include <fmt/format.h>

#include "harness/commands/renderers.hpp"
#include "harness/commands/scene_options.hpp"
#include "harness/dump/dump.hpp"
#include "harness/picture/image_io.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/shells/opencl/shells.hpp"

namespace pelage {
namespace {

struct RenderOptions {
  SceneOptions scene;
  std::string output, dump;
  RendererOptions renderer;
};

int render(const RenderOptions& options) {
  check_picture_path(options.output);
  if (!options.dump.empty()) check_dump_path(options.dump);
  const Scene resolved = resolve_scene(options.scene);
  const Scene scene = scene_at(resolved, double(resolved.dynamics.time));
  // The device is opened before the mesh is prepared. Otherwise the user would learn of an invalid device
  // name only after the preparation, which may take minutes.
  const DrawPicture draw = open_renderer(options.renderer, scene);
  const DrawnFrame frame = draw(load_scene_mesh(scene));
  write_picture(options.output, frame.image);
  if (!options.dump.empty()) frame.dump(options.dump);
  return 0;
}

std::vector<std::string> renderer_names() {
  std::vector<std::string> names;
  for (const Renderer& renderer : renderers()) names.emplace_back(renderer.name);
  return names;
}

std::string renderers_help() {
  std::string text;
  for (const Renderer& renderer : renderers())
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", renderer.name, renderer.what);
  return text;
}

}  // namespace

void add_render(CLI::App& app, Chosen& chosen) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Draw one picture of a scene");
  add_scene_options(*command, options->scene, true);
  command->add_option("-o,--output", options->output, "Picture to write: .png (8-bit), .exr or .tif (float)")
      ->required()
      ->type_name("IMAGE");
  command->add_option("--pipeline", options->renderer.pipeline, renderers_help())
      ->check(CLI::IsMember(renderer_names()))
      ->capture_default_str();
  command
      ->add_option("--opengl", options->renderer.opengl,
                   "Implementation choices of the OpenGL baseline: name=value,name=value (docs/rival.md)")
      ->type_name("OPTIONS");
  command
      ->add_option(
          "--mapping", options->renderer.mapping,
          "Mapping of pixels to work-items in the pipelines shells and strands (default: depends on the "
          "device; strands have tile and group): " +
              mappings_help())
      ->check(CLI::IsMember(mappings()))
      ->type_name("NAME");
  command
      ->add_option("--device", options->renderer.device, "Device to use: PLATFORM:INDEX, or part of its name")
      ->type_name("DEVICE");
  command
      ->add_option("--dump", options->dump, "Write all inputs and intermediate arrays of the frame as HDF5")
      ->type_name("FRAME.h5");
  command
      ->add_option(
          "--reference-bits", options->renderer.bits,
          "8: the reference rounds its picture to 8 bits per channel after every layer, like GPUs of 2010")
      ->check(CLI::IsMember({8, 32}))
      ->capture_default_str();
  command->callback([options, &chosen] { chosen = [options] { return render(*options); }; });
}

}  // namespace pelage
