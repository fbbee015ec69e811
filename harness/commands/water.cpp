#include "harness/prepare/water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/commands/commands.hpp"
#include "harness/commands/drawn_table.hpp"
#include "harness/commands/scene_options.hpp"
#include "harness/error.hpp"
#include "harness/prepare/droplets.hpp"
#include "harness/scene/keyframes.hpp"

namespace pelage {
namespace {

struct WaterOptions {
  SceneOptions scene;
  double to = 10, fps = 30;
  std::string csv = "-";
};

constexpr double most_lines = 1e6;

bool has_wetness_keyframes(const Scene& scene) {
  return std::any_of(scene.keyframes.tracks.begin(), scene.keyframes.tracks.end(),
                     [](const KeyTrack& track) { return track.key.starts_with("wetness."); });
}

/// Returns the table. If keys of the water have keyframes, the droplets are made again for each line.
std::string water_table(const Scene& scene, double to, double fps) {
  const auto mesh = load_scene_mesh(scene);
  const Skin skin = weld(*mesh);
  const bool again = has_wetness_keyframes(scene);
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
  command.add_option("--to", options.to, "Time of the last line, s; the first line is at 0")
      ->type_name("SECONDS")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  command.add_option("--fps", options.fps, "Number of lines per second")
      ->type_name("F")
      ->check(CLI::Range(0.001, 1000.0))
      ->capture_default_str();
  command
      .add_option(
          "--csv", options.csv,
          "Output file (.csv); a file .svg or .pdf is drawn in both formats, beside the .csv; - is standard output")
      ->type_name("FILE")
      ->capture_default_str();
}

}  // namespace pelage
