// pelage groom: writes the strands of a scene as polylines.
#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "harness/commands/commands.hpp"
#include "harness/commands/scene_options.hpp"
#include "harness/mesh/read/polylines.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/strands/reference/drawing.hpp"
#include "harness/strands/scene/strand_input.hpp"

namespace pelage {
namespace {

struct GroomOptions {
  SceneOptions scene;
  std::filesystem::path output;
};

/// Returns the strands at rest. Those of a fur layer have points at equal steps of the curve's parameter
/// (docs/strands.md, section Curve); those of a file have its points.
Polylines polylines_of(const strands::StrandInput& input) {
  if (input.mesh->strands) return input.mesh->strands->lines;
  Polylines lines;
  const int segments = input.scene.strands.segments;
  for (const strands::KeyedStrand& strand : input.fur.strands) {
    const strands::DrawnStrand drawn =
        strands::reference::between(input.fur.keys, strand, input.dynamics.first_segment);
    lines.count.push_back(std::uint32_t(segments) + 1);
    for (int k = 0; k <= segments; ++k) {
      const double t = double(k) / segments, s = 1 - t;
      lines.point.emplace_back(s * s * glm::dvec3(drawn.point[0]) + 2 * s * t * glm::dvec3(drawn.point[1]) +
                               t * t * glm::dvec3(drawn.point[2]));
      lines.width.push_back(float(2 * strands::reference::half_width(input.look, drawn, t)));
      lines.colour.push_back(drawn.colour);
    }
  }
  return lines;
}

int groom(const GroomOptions& options) {
  check_polylines_path(options.output);
  const Scene scene = scene_at(resolve_scene(options.scene, "strands"), 0);
  const auto input = strands::prepare_strands(
      scene, load_scene_mesh(scene, [](const std::string& text) { fmt::print(stderr, "{}\n", text); }));
  const Polylines lines = polylines_of(*input);
  write_polylines(options.output, lines,
                  fmt::format("pelage groom, model {}; unit: radius of the model", scene.model));
  fmt::print("{}: {}\n", options.output.string(), describe(lines));
  return 0;
}

}  // namespace

void add_groom(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<GroomOptions>(
      app, chosen, "groom", "Write the strands of a scene, at rest, as polylines for other programs", groom);
  add_scene_options(command, options.scene, true);
  add_value(command, "-o,--output", options.output, "FILE",
            "File to write: .hair (Cem Yuksel's format, with widths and colours) or .obj (lines)")
      ->required();
}

}  // namespace pelage
