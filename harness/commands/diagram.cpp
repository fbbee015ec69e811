// pelage diagram and pelage water: tables and pictures for the papers' figures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "harness/atomic_file.hpp"
#include "harness/commands/commands.hpp"
#include "harness/commands/scene_options.hpp"
#include "harness/compare/frame_output.hpp"
#include "harness/diagrams/diagrams.hpp"
#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/picture/image_io.hpp"
#include "harness/prepare/droplets.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/prepare/water.hpp"
#include "harness/report/plot_spec.hpp"
#include "harness/scene/keyframes.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

/// Throws InputError unless write_drawn_table() can write to `output`: "-", or a .csv, .svg or .pdf file in a
/// folder that exists. `what` names the table in the message.
void check_table_path(const std::string& output, const std::string& what) {
  if (output == "-") return;
  const std::string ending = fs::path(output).extension().string();
  if (ending != ".csv" && ending != ".svg" && ending != ".pdf")
    throw InputError(
        fmt::format("{}: {} is a table; it is written as .csv, or drawn as .svg and .pdf", output, what));
  require_place(output);
}

/// Prints the CSV text if `output` is "-", and writes it otherwise. If `output` ends in .svg or .pdf, the
/// text is written beside it as .csv, and the program harness/report/plots/section.py draws it in both
/// formats. Throws InputError if the program cannot draw.
void write_drawn_table(const std::string& output, const std::string& text) {
  if (output == "-") {
    fmt::print("{}", text);
    return;
  }
  const fs::path file = output, table = fs::path(file).replace_extension(".csv");
  write_text_atomically(table, text);
  if (file.extension() == ".csv") return;
  const std::string problem = draw_plot(plot_program("section"), table, fs::path(file).replace_extension());
  if (!problem.empty()) throw InputError(fmt::format("{}: {}", file.string(), problem));
}

struct DiagramOptions {
  std::string kind, output = "-", device;
  SceneOptions scene;
  int side = 1024;
  std::size_t most = 400;
  double width = 1.5;
};

Picture mask_of(const Scene& scene, const DiagramOptions& options) {
  const auto input = prepare(scene, load_scene_mesh(scene));
  return diagrams::mask_picture(*input, reference_mask(*input, 0), options.side);
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
  const FrameOutput motion = reference_motion(*input, frames_before(scene.dynamics) + 1);
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

diagrams::Section shape_of(const Scene& scene, const DiagramOptions&) {
  return diagrams::shape_section(scene);
}

diagrams::Section curl_of(const Scene& scene, const DiagramOptions&) {
  return diagrams::curl_section(scene);
}

diagrams::Section clump_of(const Scene& scene, const DiagramOptions&) {
  const glm::vec2 length = load_scene_mesh(scene)->length_per_uv;
  return diagrams::clump_section(scene, 0.5 * (double(length.x) + double(length.y)));
}

diagrams::Section layers_of(const Scene& scene, const DiagramOptions&) {
  return diagrams::layer_section(*prepare(scene, load_scene_mesh(scene)), frames_before(scene.dynamics) + 1);
}

diagrams::Section path_of(const Scene& scene, const DiagramOptions& options) {
  const auto mesh = load_scene_mesh(scene);
  if (scene.pipeline.starts_with("strands"))
    return diagrams::path_section(*strands::prepare_strands(scene, mesh), options.most);
  return diagrams::path_section(*prepare(scene, mesh), options.most);
}

/// A diagram that this command draws: either a picture or a table.
struct Kind {
  const char* name;
  const char* what;
  Picture (*picture)(const Scene&, const DiagramOptions&);
  diagrams::Section (*section)(const Scene&, const DiagramOptions&);
};

constexpr Kind kinds[] = {
    {"mask", "the wetness mask with the triangles of the UV map", mask_of, nullptr},
    {"coat", "the coat's colour texture", coat_of, nullptr},
    {"slices", "four slices of the fur's volume texture", slices_of, nullptr},
    {"lines", "the fur with the strands of the mass-spring model as white lines", lines_of, nullptr},
    {"wind", "the fur with a red arrow in the direction of the wind", wind_of, nullptr},
    {"shape", "the factor f(h) of S Eq. 5 for five values of clump.shape", nullptr, shape_of},
    {"clump", "the strands of a clump in a vertical plane", nullptr, clump_of},
    {"curl", "the curl of an upright strand for three wetnesses", nullptr, curl_of},
    {"layers", "the layers over the cut of the mesh by the plane z = 0", nullptr, layers_of},
    {"path", "the path of the tip that moves farthest, from 0 s to dynamics.time", nullptr, path_of},
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
    write_drawn_table(options.output, diagrams::csv_of(kind->section(scene, options)));
  else
    write_picture(options.output, kind->picture(scene, options));
  return 0;
}

}  // namespace

bool draws_table(const std::string& kind) {
  return std::ranges::any_of(kinds, [&](const Kind& k) { return kind == k.name && k.section; });
}

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
  add_value(command, "kind", options.kind, "KIND", help)->required()->check(CLI::IsMember(names));
  add_scene_options(command, options.scene, true);
  add_value(
      command, "-o,--output", options.output, "FILE",
      "Picture to write (.png, .exr or .tif), or table (.csv); a table as .svg or .pdf is drawn in both formats, beside the .csv; - prints the table");
  add_value(command, "--side", options.side, "PIXELS", "Pixels per side of the mask")
      ->check(CLI::Range(16, 8192));
  add_value(command, "--most", options.most, "N",
            "Largest number of strands that are drawn as lines, or among which path chooses")
      ->check(CLI::Range(1, 1000000));
  add_value(command, "--line-width", options.width, "PIXELS",
            "Width of the lines of strands and of the arrow, in pixels")
      ->check(CLI::Range(0.5, 50.0));
  add_value(command, "--device", options.device, "DEVICE",
            "Device that draws the fur of the kinds lines and wind: PLATFORM:INDEX, or part of its name");
}

namespace {

struct WaterOptions {
  SceneOptions scene;
  double to = 10, fps = 30;
  std::string csv = "-";
};

constexpr double most_lines = 1e6;

/// Returns the table. If keys of the water have keyframes, the droplets are made again for each line.
std::string water_table(const Scene& scene, double to, double fps) {
  const auto mesh = load_scene_mesh(scene);
  const Skin skin = weld(*mesh);
  const bool again = std::any_of(scene.keyframes.tracks.begin(), scene.keyframes.tracks.end(),
                                 [](const KeyTrack& track) { return track.key.starts_with("wetness."); });
  std::vector<Droplet> droplets;
  std::string text = water_csv_header();
  const auto lines = std::size_t(std::floor(to * fps + 1e-6)) + 1;
  for (std::size_t i = 0; i < lines; ++i) {
    const double seconds = double(i) / fps;
    const WetnessScene wetness = scene_at(scene, seconds).wetness;
    if (i == 0 || again) droplets = make_droplets(mesh, skin, wetness);
    text += water_csv_line(wetness, droplets, mesh->length_per_uv, seconds);
  }
  return text;
}

int follow_water(const WaterOptions& options) {
  if (options.to * options.fps > most_lines)
    throw InputError(fmt::format("--to {} --fps {}: {:.0f} lines; give at most {:.0f}", options.to,
                                 options.fps, options.to * options.fps, most_lines));
  check_table_path(options.csv, "the account of the water");
  write_drawn_table(options.csv, water_table(resolve_scene(options.scene), options.to, options.fps));
  return 0;
}

}  // namespace

void add_water(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<WaterOptions>(
      app, chosen, "water", "Write where the water of a scene is over time, as CSV", follow_water);
  add_scene_options(command, options.scene, false);
  add_value(command, "--to", options.to, "SECONDS", "Time of the last line, s; the first line is at 0")
      ->check(CLI::Range(0.0, 3600.0));
  add_value(command, "--fps", options.fps, "F", "Number of lines per second")
      ->check(CLI::Range(0.001, 1000.0));
  add_value(
      command, "--csv", options.csv, "FILE",
      "Output file (.csv); a file .svg or .pdf is drawn in both formats, beside the .csv; - is standard output");
}

}  // namespace pelage
