#include <fmt/format.h>

#include <filesystem>

#include "harness/commands/commands.hpp"
#include "harness/commands/drawn_table.hpp"
#include "harness/commands/renderers.hpp"
#include "harness/commands/scene_options.hpp"
#include "harness/compare/frame_output.hpp"
#include "harness/diagrams/mask_picture.hpp"
#include "harness/diagrams/section.hpp"
#include "harness/diagrams/strand_lines.hpp"
#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/picture/image_io.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/scene/keyframes.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

struct DiagramOptions {
  std::string kind, output = "-", device;
  SceneOptions scene;
  int side = 1024;
  std::size_t most = 400;
  double width = 1.5;
};

/// Number of frames after which the fur is shown.
int frames_of(const Scene& scene) {
  return frames_before(scene.dynamics) + 1;
}

Picture mask_of(const Scene& scene, const DiagramOptions& options) {
  const auto input = prepare(scene, load_scene_mesh(scene));
  return diagrams::mask_picture(*input, reference_motion(*input, 0).mask, options.side);
}

Picture coat_of(const Scene& scene, const DiagramOptions&) {
  return diagrams::coat_picture(prepare(scene, load_scene_mesh(scene))->coat);
}

Picture slices_of(const Scene& scene, const DiagramOptions&) {
  return diagrams::slices_picture(prepare(scene, load_scene_mesh(scene))->fur);
}

Picture drawn(const Scene& scene, const std::shared_ptr<const Mesh>& mesh, const DiagramOptions& options) {
  RendererOptions choice;
  choice.pipeline = default_pipeline;
  choice.device = options.device;
  return open_renderer(choice, scene, scene)->draw(scene, mesh);
}

Picture lines_of(const Scene& scene, const DiagramOptions& options) {
  const auto mesh = load_scene_mesh(scene);
  Picture picture = drawn(scene, mesh, options);
  const auto input = prepare(scene, mesh);
  const FrameOutput motion = reference_motion(*input, frames_of(scene));
  diagrams::draw_strands(picture, *input, diagrams::strand_curves(*input, motion.tips, options.most),
                         options.width);
  return picture;
}

Picture wind_of(const Scene& scene, const DiagramOptions& options) {
  const auto mesh = load_scene_mesh(scene);
  Picture picture = drawn(scene, mesh, options);
  diagrams::draw_wind_arrow(picture, *prepare(scene, mesh), options.width);
  return picture;
}

diagrams::Section clump_of(const Scene& scene) {
  const glm::vec2 length = load_scene_mesh(scene)->length_per_uv;
  return diagrams::clump_section(scene, 0.5 * (double(length.x) + double(length.y)));
}

diagrams::Section layers_of(const Scene& scene) {
  return diagrams::layer_section(*prepare(scene, load_scene_mesh(scene)), frames_of(scene));
}

/// A diagram that this command draws: either a picture or a table.
struct Kind {
  const char* name;
  const char* what;
  Picture (*picture)(const Scene&, const DiagramOptions&);
  diagrams::Section (*section)(const Scene&);
};

constexpr Kind kinds[] = {
    {"mask", "the wetness mask with the triangles of the UV map", mask_of, nullptr},
    {"coat", "the coat's colour texture", coat_of, nullptr},
    {"slices", "four slices of the fur's volume texture", slices_of, nullptr},
    {"lines", "the fur with the strands of the mass-spring model as white lines", lines_of, nullptr},
    {"wind", "the fur with a red arrow in the direction of the wind", wind_of, nullptr},
    {"shape", "the factor f(h) of S Eq. 5 for five values of clump.shape", nullptr, diagrams::shape_section},
    {"clump", "the strands of a clump in a vertical plane", nullptr, clump_of},
    {"curl", "the curl of an upright strand for three wetnesses", nullptr, diagrams::curl_section},
    {"layers", "the layers over the cut of the mesh by the plane z = 0", nullptr, layers_of},
};

int diagram(const DiagramOptions& options) {
  const Kind* kind = nullptr;
  for (const Kind& k : kinds)
    if (options.kind == k.name) kind = &k;
  if (kind->picture) {
    if (options.output == "-")
      throw InputError(fmt::format("diagram {}: is a picture; give a file with -o, such as {}.png",
                                   options.kind, options.kind));
    check_picture_path(options.output);
  } else {
    check_table_path(options.output, "diagram " + options.kind);
  }
  const Scene resolved = resolve_scene(options.scene);
  const Scene scene = scene_at(resolved, double(resolved.dynamics.time));
  if (kind->section)
    write_drawn_table(options.output, diagrams::csv_of(kind->section(scene)));
  else
    write_picture(options.output, kind->picture(scene, options));
  return 0;
}

}  // namespace

void add_diagram(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<DiagramOptions>(
      app, chosen, "diagram", "Draw an inset, a section or an overlay of a scene (docs/experiments.md)",
      diagram);
  std::string help;
  std::vector<std::string> names;
  for (const Kind& k : kinds) {
    names.emplace_back(k.name);
    help += fmt::format("{}{}: {}", help.empty() ? "" : "; ", k.name, k.what);
  }
  command.add_option("kind", options.kind, help)->required()->check(CLI::IsMember(names))->type_name("KIND");
  add_scene_options(command, options.scene, true);
  command
      .add_option(
          "-o,--output", options.output,
          "Picture to write (.png, .exr or .tif), or table (.csv); a table as .svg or .pdf is drawn in both formats, beside the .csv; - prints the table")
      ->type_name("FILE")
      ->capture_default_str();
  command.add_option("--side", options.side, "Pixels per side of the mask")
      ->check(CLI::Range(16, 8192))
      ->type_name("PIXELS")
      ->capture_default_str();
  command.add_option("--most", options.most, "Largest number of strands that are drawn as lines")
      ->check(CLI::Range(1, 1000000))
      ->type_name("N")
      ->capture_default_str();
  command
      .add_option("--line-width", options.width, "Width of the lines of strands and of the arrow, in pixels")
      ->check(CLI::Range(0.5, 50.0))
      ->type_name("PIXELS")
      ->capture_default_str();
  command
      .add_option(
          "--device", options.device,
          "Device that draws the fur of the kinds lines and wind: PLATFORM:INDEX, or part of its name")
      ->type_name("DEVICE");
}

}  // namespace pelage
