#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "harness/atomic_file.hpp"
#include "harness/commands/commands.hpp"
#include "harness/commands/scene_options.hpp"
#include "harness/error.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/mesh/models.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/springs/model/drawing.hpp"
#include "harness/springs/model/layout.hpp"
#include "harness/springs/model/network.hpp"
#include "kernels/simulate/params.h"

namespace pelage {
namespace {

struct TopologyCommand {
  std::string model, up = "y";
  std::optional<std::uint32_t> faces;
  std::string drawing;
  float length = 0.15f;
};

// Maps the name of a topology to the numbers of masses and springs that a paper prints for a model.
using Published = decltype(Model::published);

Published published_of(const std::string& model) {
  for (const Model& known : models())
    if (known.name == model) return known.published;
  return {};
}

// An arbitrary fur length in R, the radius of the bounding sphere. The command prints numbers of masses and
// springs and sizes of memory, which do not depend on this length.
constexpr float any_length = 0.05f;

void row(std::string_view what, const auto& masses, const auto& springs, const std::string& degrees,
         const std::string& explicit_kib, const std::string& implicit_kib, const std::string& paper = "") {
  fmt::print("{:<36} {:>9} {:>9}  {:>14}  {:>10} {:>10}{}\n", what, masses, springs, degrees, explicit_kib,
             implicit_kib, paper.empty() ? "" : fmt::format("  {:>14}", paper));
}

void print_topology(const Mesh& mesh, springs::Kind kind, springs::Vertices vertices, std::string_view on,
                    const Published& published) {
  const springs::Solver& implicit = *std::find_if(std::begin(springs::solvers), std::end(springs::solvers),
                                                  [](const auto& s) { return s.implicit; });
  const springs::SpringNetwork built = springs::build(kind, mesh, any_length, vertices);
  const springs::Degrees d = springs::degrees(built);
  const springs::Layout layout = springs::lay_out(built, {});
  const auto kib = [&](springs::Solver solver) {
    return fmt::format("{:.0f}", double(springs::memory(layout, solver)) / 1024);
  };
  const auto said = published.find(std::string(springs::name(kind)));
  const std::string paper =
      said == published.end() ? "" : fmt::format("{} / {}", said->second[0], said->second[1]);
  row(fmt::format("{}{}", springs::name(kind), on), built.mass.size(), built.spring.size(),
      fmt::format("{} / {:.2f} / {}", d.least, d.mean, d.most), kib(springs::default_solver), kib(implicit),
      paper);
}

void write_drawing(const Mesh& mesh, const TopologyCommand& command) {
  const std::filesystem::path path = command.drawing;
  if (path.extension() != ".svg")
    throw InputError(fmt::format("--draw {}: the name of the drawing must end in .svg", command.drawing));
  const std::string svg = springs::drawing_of(mesh, command.length);
  write_text_atomically(path, svg);
}

int count_springs(const TopologyCommand& command) {
  MeshOptions options;
  options.faces = command.faces;
  MeshScene turn;
  turn.up = command.up;
  options.rotate = rotation_of(turn);
  options.progress = [](const std::string& text) { fmt::print(stderr, "{}\n", text); };
  const auto mesh = load_model(command.model, options);
  if (!command.drawing.empty()) write_drawing(*mesh, command);
  const Topology counts = topology(*mesh);
  const Published published = command.faces ? Published() : published_of(command.model);
  fmt::print(
      "{}: {} surface points, {} vertices (a point on a UV seam has several vertices), {} edges, {} faces\n",
      mesh->name, counts.points, counts.copies, counts.edges, counts.faces);
  fmt::print("{:<36} {:>9} {:>9}  {:>14}  {:>21}{}\n", "", "", "", "springs per top", "device memory, KiB",
             published.empty() ? "" : "       in the paper");
  row("topology", "masses", "springs", "least/mean/most", "explicit", "implicit",
      published.empty() ? "" : "masses/springs");
  for (const springs::Kind kind : springs::kinds)
    print_topology(*mesh, kind, springs::Vertices::points, "", published);
  const std::size_t strands = (counts.faces + 15) / 16 * 16 * sizeof(float) *
                              (std::size_t(VIRTUAL_STRAND_COLUMNS) + std::size_t(STATE_COLUMNS));
  row("strands (Silva et al. 2010)", counts.faces, counts.faces, "1 / 1.00 / 1",
      fmt::format("{:.0f}", double(strands) / 1024), "-");
  if (counts.copies != counts.points)
    for (const springs::Kind& kind : springs::kinds)
      if (!kind.separable)
        print_topology(*mesh, kind, springs::Vertices::copies, " on vertex copies", published);
  return 0;
}

}  // namespace

void add_topology(CLI::App& app, Chosen& chosen) {
  auto options = std::make_shared<TopologyCommand>();
  CLI::App* command = app.add_subcommand(
      "topology",
      "Print the masses, springs and memory of each topology over a model, and draw the topologies");
  command
      ->add_option("model", options->model, "Name of a model, or a mesh file: OBJ, OFF, PLY, STL, 3DS, glTF")
      ->required();
  command->add_option("--faces", options->faces,
                      "Simplify or refine the mesh to exactly this number of triangles");
  add_up_option(*command, options->up);
  command->add_option("--draw", options->drawing, "Draw the four topologies into this file")
      ->type_name("PICTURE.svg");
  command
      ->add_option("--length", options->length,
                   "Length of the sticks in the drawing, in radii of the bounding sphere")
      ->check(CLI::Range(0.001f, 10.0f))
      ->capture_default_str();
  command->callback([options, &chosen] { chosen = [options] { return count_springs(*options); }; });
}

}  // namespace pelage
