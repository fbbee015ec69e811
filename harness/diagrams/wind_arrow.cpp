#include "harness/diagrams/wind_arrow.hpp"

#include <glm/geometric.hpp>

#include "harness/diagrams/lines.hpp"
#include "harness/error.hpp"
#include "harness/shells/reference/coverage.hpp"

namespace pelage::diagrams {
namespace {

constexpr glm::vec4 red{0.9f, 0.1f, 0.08f, 1};
constexpr double head = 0.3;              // length of the head's lines, as a fraction of the arrow's length
constexpr double least_on_screen = 0.02;  // shortest arrow, as a fraction of the picture's height

}  // namespace

void draw_wind_arrow(Picture& picture, const FrameInput& input, double width) {
  const WindScene& wind = input.scene.dynamics.wind;
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
