#include <fmt/format.h>
#include <fmt/ranges.h>

#include <glm/common.hpp>

#include "harness/compare/frame_output.hpp"
#include "harness/diagrams/diagrams.hpp"
#include "harness/shells/reference/layers.hpp"
#include "harness/shells/reference/mask.hpp"

namespace pelage::diagrams {
namespace {

constexpr int strands_per_radius = 8;  // strands of a section on one radius of the clump
constexpr int curl_points = 256;       // pieces of a strand in curl_section()

/// Returns the height over the surface, in R, of the layer at `h` of an upright strand at rest.
double upright_height(const Scene& scene, double h) {
  const glm::dvec3 up(0, 0, double(scene.fur.length));
  if (has_springs(scene.dynamics)) return h * up.z;
  return reference::bezier(up, up, reference::bezier_parameter(h, scene.fur.layer_spacing)).z;
}

double height_of(const Scene& scene, int layer) {
  return layer < 0 ? 0.0 : reference::layer_height(layer, scene.fur.layers);
}

}  // namespace

std::string csv_of(const Section& section) {
  std::string text = fmt::format("{}\n", fmt::join(section.columns, ","));
  for (const std::vector<double>& row : section.rows) text += fmt::format("{:.9g}\n", fmt::join(row, ","));
  return text;
}

Section shape_section(const Scene& scene) {
  Section section{{"w", "h", "f"}, {}};
  for (const double w : {0.0, 0.25, 0.5, 0.75, 1.0})
    for (int n = 0; n < scene.fur.layers; ++n) {
      const double h = height_of(scene, n);
      section.rows.push_back({w, h, reference::clump_shape(h, w, scene.fur.layers, scene.clump.function)});
    }
  return section;
}

Section clump_section(const Scene& scene, double length_per_uv) {
  Section section{{"strand", "inside", "layer", "h", "f", "root", "u", "d", "x", "y"}, {}};
  const double radius =
      double(scene.wetness.radius) / (scene.wetness.unit == "surface" ? length_per_uv : 1.0);
  const reference::Clump clump{glm::dvec2(0), radius, double(scene.wetness.wetness)};
  for (int i = -2 * strands_per_radius; i <= 2 * strands_per_radius; ++i) {
    const double root = clump.radius * i / strands_per_radius;
    const bool wet = std::abs(i) <= strands_per_radius;
    for (int n = -1; n < scene.fur.layers; ++n) {
      const double h = height_of(scene, n), shape = double(scene.clump.shape);
      const double f = n < 0 ? 0.0 : reference::clump_shape(h, shape, scene.fur.layers, scene.clump.function);
      const double u = wet ? reference::drawn_at(scene, clump, f, glm::dvec2(root, 0)).x : root;
      section.rows.push_back({double(i), wet ? 1.0 : 0.0, double(n), h, f, root, u, root - u,
                              u * length_per_uv, upright_height(scene, h)});
    }
  }
  return section;
}

Section curl_section(const Scene& scene) {
  Section section{{"rho", "h", "x", "y", "z"}, {}};
  for (const double rho : {0.0, 0.5, 1.0})
    for (int i = 0; i <= curl_points; ++i) {
      const double h = double(i) / curl_points;
      const glm::dvec3 phi =
          reference::curl(h, rho, double(scene.curl.radius), double(scene.curl.turns), {1, 0, 0}, {0, 1, 0});
      section.rows.push_back({rho, h, phi.x, phi.y, upright_height(scene, h)});
    }
  return section;
}

Section layer_section(const FrameInput& input, int frames) {
  Section section{{"segment", "end", "layer", "h", "x", "y"}, {}};
  const FrameOutput motion = reference_motion(input, frames);
  const std::vector<glm::dvec3> sticks(motion.tips.begin(), motion.tips.end());
  const reference::Geometry geometry(input, reference::wetness_mask(input), frames, {},
                                     reference::Mutant::none,
                                     has_springs(input.scene.dynamics) ? sticks : std::vector<glm::dvec3>{});
  const Mesh& mesh = *input.mesh;
  std::size_t segment = 0;
  for (std::size_t f = 0; f < mesh.triangle.size(); ++f) {
    /// A point of the cut: the two corners of the cut edge, and the share of the second corner.
    struct Crossing {
      std::size_t from, to;
      double share;
    };
    std::vector<Crossing> ends;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t next = (c + 1) % 3;
      const double a = double(mesh.position[mesh.triangle[f][int(c)]].z),
                   b = double(mesh.position[mesh.triangle[f][int(next)]].z);
      if ((a < 0) != (b < 0)) ends.push_back({c, next, a / (a - b)});
    }
    if (ends.size() != 2) continue;
    for (int n = -1; n < input.scene.fur.layers; ++n)
      for (std::size_t e = 0; e < 2; ++e) {
        const glm::dvec3 p = glm::mix(geometry.position(geometry.slot(f, ends[e].from), n),
                                      geometry.position(geometry.slot(f, ends[e].to), n), ends[e].share);
        section.rows.push_back({double(segment), double(e), double(n), height_of(input.scene, n), p.x, p.y});
      }
    ++segment;
  }
  return section;
}

}  // namespace pelage::diagrams
