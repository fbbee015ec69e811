#include <fmt/format.h>

#include "harness/commands/commands.hpp"
#include "harness/commands/renderers.hpp"
#include "harness/commands/scene_options.hpp"
#include "harness/dump/dump.hpp"
#include "harness/picture/image_io.hpp"
#include "harness/scene/keyframes.hpp"

namespace pelage {
namespace {

struct RenderOptions {
  SceneOptions scene;
  std::string output, dump;
  RendererOptions renderer;
};

/// Prints the name of the device and the time of its first frame, which has no warm-up, unless the pipeline
/// runs on the host.
void report_first_frame(const Renderer& renderer) {
  if (renderer.device().empty()) return;
  fmt::print(stderr, "{}: {:.1f} ms for the first frame, without warm-up; use `pelage run` to time frames\n",
             renderer.device(), renderer.ms());
}

int render(const RenderOptions& options) {
  check_picture_path(options.output);
  if (!options.dump.empty()) check_dump_path(options.dump);
  const Scene resolved = resolve_scene(options.scene);
  const Scene scene = scene_at(resolved, double(resolved.dynamics.time));
  // The device is opened before the mesh is prepared. Otherwise the user would learn of an invalid device
  // name only after the preparation, which may take minutes.
  const std::unique_ptr<Renderer> renderer = open_renderer(options.renderer, resolved, scene);
  const Picture picture = renderer->draw(scene, load_drawn_mesh(options.renderer, scene));
  report_first_frame(*renderer);
  write_picture(options.output, picture);
  if (!options.dump.empty()) renderer->dump(options.dump);
  return 0;
}

}  // namespace

void add_render(CLI::App& app, Chosen& chosen) {
  auto [command, options] =
      add_command<RenderOptions>(app, chosen, "render", "Draw one picture of a scene", render);
  add_scene_options(command, options.scene, true);
  command.add_option("-o,--output", options.output, "Picture to write: .png (8-bit), .exr or .tif (float)")
      ->required()
      ->type_name("IMAGE");
  add_renderer_options(command, options.renderer);
  command.add_option("--dump", options.dump, "Write all inputs and intermediate arrays of the frame as HDF5")
      ->type_name("FRAME.h5");
}

}  // namespace pelage
