#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "harness/diagrams/diagrams.hpp"
#include "harness/error.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/shells/reference/coverage.hpp"
#include "harness/shells/reference/layers.hpp"

namespace pelage::diagrams {
namespace {

constexpr int pieces = 24;  // straight pieces per curve

/// A line is hidden if the base surface is nearer by more than this fraction of the view depth. Roots lie on
/// the surface, so an exact comparison would hide parts of them.
constexpr double depth_slack = 2e-3;

/// Returns 1/w of the base surface at each pixel, 0 where there is none.
std::vector<double> base_depth(const FrameInput& input) {
  const Camera& camera = input.camera;
  const Window whole{0, 0, camera.width, camera.height};
  std::vector<double> depth(std::size_t(camera.width) * std::size_t(camera.height), 0.0);
  for (const glm::uvec3& t : input.mesh->triangle) {
    std::array<reference::ClipPoint, 3> corner{};
    for (int c = 0; c < 3; ++c)
      corner[std::size_t(c)] = reference::project(camera, glm::dvec3(input.mesh->position[t[c]]));
    const auto polygon = reference::clip(corner, double(camera.near));
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      const std::array<reference::ClipPoint, 3> part{polygon[0].point, polygon[i - 1].point,
                                                     polygon[i].point};
      const reference::Raster raster({snap(part[0]), snap(part[1]), snap(part[2])}, camera.width,
                                     camera.height);
      if (raster.empty()) continue;
      const Window box = raster.box(whole);
      for (int y = box.y; y < box.y + box.height; ++y)
        for (int x = box.x; x < box.x + box.width; ++x) {
          const reference::Edges edges = raster.edges(x, y);
          if (!edges.covered) continue;
          double sum = 0, inverse = 0;
          for (std::size_t k = 0; k < 3; ++k) {
            sum += double(edges.value[k]);
            inverse += double(edges.value[k]) / part[k].w;
          }
          double& nearest = depth[std::size_t(y) * std::size_t(camera.width) + std::size_t(x)];
          nearest = std::max(nearest, inverse / sum);
        }
    }
  }
  return depth;
}

/// Returns the vertex of the mesh at which stick `i` stands.
std::vector<std::uint32_t> stick_vertices(const FrameInput& input) {
  const Mesh& mesh = *input.mesh;
  std::vector<std::uint32_t> vertex;
  if (parts(input.scene)) {
    for (const glm::uvec3& t : mesh.triangle) vertex.insert(vertex.end(), {t.x, t.y, t.z});
    return vertex;
  }
  vertex.resize(mesh.welded);
  for (std::uint32_t v = 0; v < mesh.weld.size(); ++v) vertex[mesh.weld[v]] = v;
  return vertex;
}

constexpr glm::vec4 red{0.9f, 0.1f, 0.08f, 1};
constexpr double head = 0.3;              // length of the head's lines, as a fraction of the arrow's length
constexpr double least_on_screen = 0.02;  // shortest arrow, as a fraction of the picture's height

}  // namespace

std::vector<Curve> strand_curves(const FrameInput& input, const std::vector<glm::vec3>& tips,
                                 std::size_t most) {
  const Scene& scene = input.scene;
  const double length = double(scene.fur.length);
  const bool sticks = has_springs(scene.dynamics);
  const std::vector<std::uint32_t> vertex = sticks ? stick_vertices(input) : std::vector<std::uint32_t>{};
  const std::size_t count = std::min(most, tips.size());
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t strand = i * tips.size() / count;
    const glm::dvec3 tip(tips[strand]);
    Curve curve;
    for (int p = 0; p <= pieces; ++p) {
      const double h = double(p) / pieces;
      if (sticks) {
        const glm::dvec3 normal(input.stick_normal[input.mesh->weld[vertex[strand]]]);
        curve.push_back(glm::dvec3(input.mesh->position[vertex[strand]]) +
                        reference::stick_displacement(
                            scene.dynamics, reference::stick_bend(scene.dynamics, length, normal, tip), h));
      } else {
        curve.push_back(glm::dvec3(input.strands.root[strand]) +
                        reference::bezier(length * glm::dvec3(input.strands.normal[strand]), tip, h));
      }
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

void draw_strands(Picture& picture, const FrameInput& input, const std::vector<Curve>& curves, double width) {
  const std::vector<double> depth = base_depth(input);
  const glm::dvec2 centre(0.5 * picture.width, 0.5 * picture.height);
  for (const Curve& curve : curves)
    for (std::size_t i = 1; i < curve.size(); ++i) {
      const reference::ClipPoint a = reference::project(input.camera, curve[i - 1]),
                                 b = reference::project(input.camera, curve[i]);
      if (std::min(a.w, b.w) < double(input.camera.near)) continue;
      const auto in_front = [&](int x, int y, double along) {
        const double inverse = glm::mix(1.0 / a.w, 1.0 / b.w, along);
        return inverse * (1.0 + depth_slack) >=
               depth[std::size_t(y) * std::size_t(picture.width) + std::size_t(x)];
      };
      draw_line(picture, centre + glm::dvec2(a.x, a.y) / a.w, centre + glm::dvec2(b.x, b.y) / b.w, width,
                {1, 1, 1, 1}, in_front);
    }
}

void draw_line(Picture& picture, glm::dvec2 a, glm::dvec2 b, double width, const glm::vec4& colour,
               const Visible& visible) {
  const glm::dvec2 d = b - a;
  const double square = glm::dot(d, d), reach = 0.5 * width + 0.5;
  const auto first = [&](double p, double q) { return std::max(0, int(std::floor(std::min(p, q) - reach))); };
  const auto last = [&](double p, double q, int side) {
    return std::min(side - 1, int(std::ceil(std::max(p, q) + reach)));
  };
  for (int y = first(a.y, b.y); y <= last(a.y, b.y, picture.height); ++y)
    for (int x = first(a.x, b.x); x <= last(a.x, b.x, picture.width); ++x) {
      const glm::dvec2 centre(x + 0.5, y + 0.5);
      const double along = square > 0 ? std::clamp(glm::dot(centre - a, d) / square, 0.0, 1.0) : 0.0;
      const double cover = std::clamp(reach - glm::distance(centre, a + along * d), 0.0, 1.0);
      if (!(cover > 0) || (visible && !visible(x, y, along))) continue;
      const float opacity = float(cover) * colour.a;
      glm::vec4& pixel = picture.at(x, y);
      pixel = glm::mix(pixel, glm::vec4(glm::vec3(colour), 1), opacity);
    }
}

void draw_wind_arrow(Picture& picture, const FrameInput& input, double width) {
  const WindScene wind = dynamics_of_frame(input.scene, frames_before(input.scene.dynamics)).wind;
  if (!(wind.strength > 0)) throw InputError("dynamics.wind.strength is 0, so there is no wind to draw");
  const Camera& camera = input.camera;
  const double height = picture.height, depth = reference::project(camera, glm::dvec3(0)).w;
  const glm::dvec3 middle =
      glm::dvec3(camera.eye) + depth * (glm::dvec3(camera.ray) - 0.375 * height * glm::dvec3(camera.ray_dy));
  const glm::dvec3 half =
      0.125 * height * depth * double(camera.pixel) * glm::normalize(glm::dvec3(wind.direction));
  const auto on_screen = [&](const glm::dvec3& point) {
    const reference::ClipPoint p = reference::project(camera, point);
    return glm::dvec2(0.5 * picture.width, 0.5 * height) + glm::dvec2(p.x, p.y) / p.w;
  };
  const glm::dvec2 from = on_screen(middle - half), to = on_screen(middle + half), along = to - from;
  if (glm::length(along) < least_on_screen * height)
    throw InputError("dynamics.wind.direction is the line of sight; an arrow cannot show it");
  const glm::dvec2 across(-along.y, along.x);
  draw_line(picture, from, to, width, red);
  for (const double side : {-0.5, 0.5})
    draw_line(picture, to, to - head * (along + side * across), width, red);
}

}  // namespace pelage::diagrams
