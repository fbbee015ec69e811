// pelage mesh and pelage topology: prepares a mesh, and prints and draws what is made of it.
#include "harness/mesh/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/geometric.hpp>
#include <optional>
#include <set>
#include <string>

#include "harness/atomic_file.hpp"
#include "harness/commands/commands.hpp"
#include "harness/commands/scene_options.hpp"
#include "harness/error.hpp"
#include "harness/mesh/models.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/picture/image_io.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/springs/model/layout.hpp"
#include "harness/springs/model/network.hpp"
#include "kernels/simulate/params.h"

namespace pelage {
namespace {

/// Options of the commands mesh and topology: a model or mesh file, and how to load it.
struct SourceOptions {
  std::string model, up = "y";
  std::optional<std::uint32_t> faces;
  std::vector<float> rotate;

  MeshOptions mesh_options() const {
    MeshOptions options;
    options.faces = faces;
    MeshScene turn;
    turn.up = up;
    if (!rotate.empty()) turn.rotate = {rotate[0], rotate[1], rotate[2]};
    options.rotate = rotation_of(turn);
    options.progress = [](const std::string& text) { fmt::print(stderr, "{}\n", text); };
    return options;
  }
};

void declare(CLI::App& command, SourceOptions& options) {
  command
      .add_option("model", options.model, "Name of a model, or a mesh file: OBJ, OFF, PLY, STL, 3DS, glTF")
      ->required();
  command.add_option("--faces", options.faces,
                     "Simplify or refine the mesh to exactly this number of triangles");
  add_up_option(command, options.up);
}

struct MeshCommand : SourceOptions {
  std::filesystem::path output, atlas;
  bool keep_uv = false, even_uv = false;
  std::string components = "all";
};

void fill(Picture& picture, const Mesh& mesh, const glm::uvec3& t, glm::vec4 colour) {
  glm::vec2 p[3];
  for (int k = 0; k < 3; ++k)  // v increases upwards, pixel rows downwards
    p[k] = glm::vec2(mesh.uv[t[k]].x, 1 - mesh.uv[t[k]].y) * float(picture.width) - 0.5f;
  const auto low = glm::vec2(std::min({p[0].x, p[1].x, p[2].x}), std::min({p[0].y, p[1].y, p[2].y}));
  const auto high = glm::vec2(std::max({p[0].x, p[1].x, p[2].x}), std::max({p[0].y, p[1].y, p[2].y}));
  const auto side = [](glm::vec2 a, glm::vec2 b, glm::vec2 q) {
    return (b.x - a.x) * (q.y - a.y) - (b.y - a.y) * (q.x - a.x);
  };
  for (int y = std::max(0, int(std::floor(low.y))); y <= std::min(picture.height - 1, int(high.y) + 1); ++y) {
    for (int x = std::max(0, int(std::floor(low.x))); x <= std::min(picture.width - 1, int(high.x) + 1);
         ++x) {
      const glm::vec2 q(x, y);
      const float a = side(p[0], p[1], q), b = side(p[1], p[2], q), c = side(p[2], p[0], q);
      if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)) picture.at(x, y) = colour;
    }
  }
}

void line(Picture& picture, glm::vec2 a, glm::vec2 b, glm::vec4 colour) {
  a = glm::vec2(a.x, 1 - a.y) * float(picture.width) - 0.5f;
  b = glm::vec2(b.x, 1 - b.y) * float(picture.width) - 0.5f;
  const int steps = std::max(1, int(2 * std::max(std::abs(b.x - a.x), std::abs(b.y - a.y))));
  for (int i = 0; i <= steps; ++i) {
    const glm::vec2 p = a + (b - a) * (float(i) / float(steps));
    const int x = int(std::lround(p.x)), y = int(std::lround(p.y));
    if (x >= 0 && y >= 0 && x < picture.width && y < picture.height) picture.at(x, y) = colour;
  }
}

// Draws the UV map. Each chart has a pale colour. Seams of the UV map and borders of the mesh are black. A
// face is darker than its chart's colour if its share of the UV area is smaller than its share of the surface
// area; otherwise it is lighter. Flipped faces (negative UV area) are red. A red cross marks each flipped
// face, because a face can be smaller than a pixel.
Picture draw_atlas(const Mesh& mesh, int side) {
  Picture picture{side, side, std::vector<glm::vec4>(std::size_t(side) * std::size_t(side), glm::vec4(1))};
  const std::vector<std::uint32_t> chart = charts(mesh);
  const float length = mesh.length_per_uv.x * mesh.length_per_uv.y;
  std::vector<std::size_t> flipped;
  for (std::size_t f = 0; f < mesh.triangle.size(); ++f) {
    const glm::uvec3& t = mesh.triangle[f];
    const glm::vec2 d = mesh.uv[t.y] - mesh.uv[t.x], e = mesh.uv[t.z] - mesh.uv[t.x];
    const glm::vec3 a = mesh.position[t.y] - mesh.position[t.x], b = mesh.position[t.z] - mesh.position[t.x];
    const float uv = d.x * e.y - d.y * e.x, surface = glm::length(glm::cross(a, b));
    if (uv < 0) flipped.push_back(f);
    const float ratio = surface > 0 ? std::abs(uv) * length / surface : 1.0f;
    const float hue = 2.4f * float(chart[f]),
                light = std::clamp(0.75f + 0.2f * std::log2(std::max(ratio, 0.01f)), 0.25f, 0.95f);
    const glm::vec3 tint(0.9f + 0.1f * std::cos(hue), 0.9f + 0.1f * std::cos(hue - 2.1f),
                         0.9f + 0.1f * std::cos(hue + 2.1f));
    fill(picture, mesh, t, glm::vec4(light * tint, 1));
  }
  // After the loop below, the set contains the directed edges whose opposite edge does not exist. These edges
  // are the UV seams and the borders of the mesh.
  std::set<std::pair<std::uint32_t, std::uint32_t>> once;
  for (const glm::uvec3& t : mesh.triangle)
    for (int k = 0; k < 3; ++k)
      if (!once.erase({t[(k + 1) % 3], t[k]})) once.insert({t[k], t[(k + 1) % 3]});
  for (const auto& [a, b] : once) line(picture, mesh.uv[a], mesh.uv[b], glm::vec4(0, 0, 0, 1));
  for (const std::size_t f : flipped) {
    const glm::uvec3& t = mesh.triangle[f];
    const glm::vec4 red(0.9f, 0, 0, 1);
    fill(picture, mesh, t, red);
    const float arm = 3.0f / float(side);
    line(picture, mesh.uv[t.x] - glm::vec2(arm, 0), mesh.uv[t.x] + glm::vec2(arm, 0), red);
    line(picture, mesh.uv[t.x] - glm::vec2(0, arm), mesh.uv[t.x] + glm::vec2(0, arm), red);
  }
  return picture;
}

void print_mesh(const Mesh& mesh) {
  const Topology t = topology(mesh);
  const UvQuality q = uv_quality(mesh);
  fmt::print("{}, content {}\n", mesh.name, mesh.hash);
  for (const std::string& note : mesh.notes) fmt::print("  {}\n", note);
  fmt::print("vertices: {} (a point on a UV seam has several vertices); points {}; edges {}; faces {}\n",
             t.copies, t.points, t.edges, t.faces);
  fmt::print("components {}; genus {} (sum over the components); borders {} ({} edges in total); {}\n",
             t.components, t.genus, t.borders, t.boundary_edges,
             t.manifold() ? "manifold"
                          : fmt::format("NOT manifold: {} edges and {} points", t.bad_edges, t.bad_points));
  fmt::print(
      "UV: {} chart{}{}, {:.1f}% of the square covered; flipped {} faces, {:.4f}% of the map; overlapping {:.4f}%\n",
      q.charts, q.charts == 1 ? "" : "s", mesh.periodic_uv ? " (periodic)" : "", 100 * q.covered,
      q.flipped_faces, 100 * q.flipped, 100 * q.overlapping);
  fmt::print(
      "UV area / surface area of a face, divided by the same ratio of the whole map (1: no distortion): {:.2f} at the 1% quantile, {:.2f} at the median, {:.2f} at the 99% quantile\n",
      q.area_low, q.area_median, q.area_high);
  fmt::print(
      "density of the fur (strands per surface area) / its mean: {:.2f} at the 5% quantile, {:.2f} at the 95% quantile, {:.2f} times as much\n",
      q.area_5, q.area_95, q.area_5 > 0 ? q.area_95 / q.area_5 : 0.0);
  fmt::print(
      "surface length per unit of u: {:.3f}, per unit of v: {:.3f} (in radii R of the bounding sphere)\n",
      mesh.length_per_uv.x, mesh.length_per_uv.y);
}

int prepare_mesh(const MeshCommand& command) {
  if (!command.atlas.empty()) check_picture_path(command.atlas);
  MeshOptions options = command.mesh_options();
  options.keep_uv = command.keep_uv;
  options.even_uv = command.even_uv;
  options.largest_only = command.components == "largest";
  const auto mesh = load_model(command.model, options);
  print_mesh(*mesh);
  for (const std::string& warning : uv_warnings(*mesh)) fmt::print(stderr, "{}: {}\n", mesh->name, warning);
  if (!command.output.empty()) write_ply(command.output, *mesh);
  if (!command.atlas.empty()) write_picture(command.atlas, draw_atlas(*mesh, 1024));
  return 0;
}

}  // namespace

void add_mesh(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<MeshCommand>(
      app, chosen, "mesh", "Prepare a mesh; print its size, its topology and the quality of its UV map",
      prepare_mesh);
  declare(command, options);
  command.add_option("-o,--output", options.output, "Write the prepared mesh as PLY with its UV map");
  CLI::Option* keep =
      command.add_flag("--keep-uv", options.keep_uv, "Keep the file's own UV map (OBJ, PLY, 3DS, glTF)");
  command
      .add_flag(
          "--even-uv", options.even_uv,
          "Give a chart of its own to each part of the surface that the computed UV map shrinks or enlarges by much, so that the density of the fur varies less")
      ->excludes(keep);
  command
      .add_option("--components", options.components,
                  "Connected components to keep: all that are closed or large, or only the largest")
      ->check(CLI::IsMember({"all", "largest"}))
      ->capture_default_str();
  add_value(command, "--rotate", options.rotate, "X,Y,Z",
            "Rotate the model about x, then y, then z by these angles in degrees, for instance -90,0,0")
      ->delimiter(',')
      ->expected(3);
  command.add_option("--atlas", options.atlas,
                     "Draw the UV map with its charts, seams and flipped faces as a picture");
}

namespace {

struct TopologyCommand : SourceOptions {
  std::string drawing;
  float length = 0.15f;
  bool markdown = false;
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
  const auto said = published.find(std::string(kind.name));
  const std::string paper =
      said == published.end() ? "" : fmt::format("{} / {}", said->second[0], said->second[1]);
  row(fmt::format("{}{}", kind.name, on), built.mass.size(), built.spring.size(),
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

/// Prints a Markdown table: the numbers that the paper prints, and ours with sticks on surface points and, if
/// the mesh has UV seams, on vertices.
void print_markdown(const Mesh& mesh, const Topology& counts, const Published& published) {
  std::string head = "| model | counted | vertices | faces |", line = "| --- | --- | --- | --- |";
  std::string paper, points, copies;
  const auto pair = [](std::size_t a, std::size_t b) { return fmt::format(" {} / {} |", a, b); };
  for (const springs::Kind& kind : springs::kinds) {
    head += fmt::format(" {} |", kind.name), line += " --- |";
    const auto said = published.find(std::string(kind.name));
    paper += said == published.end() ? " - |" : pair(said->second[0], said->second[1]);
    const auto counted = [&](springs::Vertices vertices) {
      const springs::SpringNetwork built = springs::build(kind, mesh, any_length, vertices);
      return pair(built.mass.size(), built.spring.size());
    };
    points += counted(springs::Vertices::points);
    copies += counted(springs::Vertices::copies);
  }
  const auto print = [&](std::string_view of, std::size_t vertices, std::size_t faces,
                         const std::string& cells) {
    fmt::print("| {} | {} | {} | {} |{}\n", mesh.name, of, vertices, faces, cells);
  };
  fmt::print("{}\n{}\n", head, line);
  if (const auto said = published.find("mesh"); said != published.end())
    print("in the paper", said->second[0], said->second[1], paper);
  print("on points", counts.points, counts.faces, points);
  if (counts.copies != counts.points) print("on vertex copies", counts.copies, counts.faces, copies);
}

int count_springs(const TopologyCommand& command) {
  const auto mesh = load_model(command.model, command.mesh_options());
  if (!command.drawing.empty()) write_drawing(*mesh, command);
  const Topology counts = topology(*mesh);
  Published published = command.faces ? Published() : published_of(command.model);
  if (command.markdown) {
    print_markdown(*mesh, counts, published);
    return 0;
  }
  published.erase("mesh");
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
  auto [command, options] = add_command<TopologyCommand>(
      app, chosen, "topology",
      "Print the masses, springs and memory of each topology over a model, and draw the topologies",
      count_springs);
  declare(command, options);
  add_value(command, "--draw", options.drawing, "PICTURE.svg", "Draw the four topologies into this file");
  command
      .add_option("--length", options.length,
                  "Length of the sticks in the drawing, in radii of the bounding sphere")
      ->check(CLI::Range(0.001f, 10.0f))
      ->capture_default_str();
  command.add_flag("--markdown", options.markdown,
                   "Print masses / springs as a Markdown table, beside the numbers that the paper prints");
}

}  // namespace pelage
