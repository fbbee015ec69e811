#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/error.hpp"
#include "harness/prepare/prepare.hpp"

namespace pelage {
namespace {

constexpr double fill_height = 0.88, fill_width = 0.94;

struct Axes {
  glm::dvec3 right, down, forward;
};

Axes axes(glm::dvec3 forward, glm::dvec3 up) {
  if (!(glm::length(forward) > 1e-12)) throw InputError("camera: eye and target coincide; move one of them");
  forward = glm::normalize(forward);
  glm::dvec3 right = glm::cross(forward, up);
  if (glm::length(right) < 1e-6 * glm::length(up) || !(glm::length(up) > 0))
    right = glm::cross(forward, std::abs(forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1));
  right = glm::normalize(right);
  return {right, glm::cross(forward, right), forward};
}

/// Position of the eye, in R (the mesh radius). `along` is its coordinate parallel to the view axis. `across`
/// is its coordinate on one axis perpendicular to the view axis.
struct Stand {
  double across, along;
};

/// Two rays start at the eye. Their slopes relative to the view axis are +`slope` and -`slope`. Returns the
/// position of the eye with the greatest `along` for which these rays enclose all points. Let p be the
/// coordinate of a point perpendicular to the view axis, and d its coordinate along the view axis. The first
/// ray passes through the point with the greatest p - slope * d, and the second ray through the point with
/// the greatest -p - slope * d. Each point is extended by `margin` (in R) to both sides: p - margin to
/// p + margin.
Stand touch(std::span<const glm::vec3> points, glm::dvec3 axis, glm::dvec3 forward, double slope,
            double margin) {
  double above = -1e300, below = -1e300;
  for (const glm::vec3& point : points) {
    const double p = glm::dot(axis, glm::dvec3(point)), q = slope * glm::dot(forward, glm::dvec3(point));
    above = std::max(above, p - q + margin);
    below = std::max(below, margin - p - q);
  }
  return {0.5 * (above - below), -0.5 * (above + below) / slope};
}

/// Like touch(), but the coordinate `along` of the eye is given, and the slope of the rays is unknown.
/// Bisection between 0 and `slope` finds the slope s with touch(s).along = `along`. A smaller slope gives a
/// position farther from the points, with a smaller coordinate `along`. The given `along` must therefore be
/// at most touch(slope).along.
Stand touch_from(std::span<const glm::vec3> points, glm::dvec3 axis, glm::dvec3 forward, double slope,
                 double margin, double along) {
  double narrow = 0, wide = slope;
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (narrow + wide);
    (touch(points, axis, forward, middle, margin).along < along ? narrow : wide) = middle;
  }
  return {touch(points, axis, forward, wide, margin).across, along};
}

glm::dvec3 framed_eye(const Axes& a, const ImageScene& image, double focal, double near,
                      std::span<const glm::vec3> points, double margin) {
  const double slope_x = 0.5 * fill_width * image.width / focal,
               slope_y = 0.5 * fill_height * image.height / focal;
  const Stand x = touch(points, a.right, a.forward, slope_x, margin);
  const Stand y = touch(points, a.down, a.forward, slope_y, margin);
  double along = std::min(x.along, y.along);
  for (const glm::vec3& p : points) along = std::min(along, glm::dot(a.forward, glm::dvec3(p)) - 2.0 * near);
  return a.right * touch_from(points, a.right, a.forward, slope_x, margin, along).across +
         a.down * touch_from(points, a.down, a.forward, slope_y, margin, along).across + a.forward * along;
}

}  // namespace

Camera make_camera(const CameraScene& scene, const ImageScene& image, std::span<const glm::vec3> points,
                   float margin) {
  const double focal = 0.5 * image.height / std::tan(double(scene.fov) * std::numbers::pi / 360.0);
  const glm::dvec3 look =
      scene.framed ? -glm::dvec3(scene.direction) : glm::dvec3(scene.target) - glm::dvec3(scene.eye);
  const Axes a = axes(look, glm::dvec3(scene.up));
  const glm::dvec3 eye = scene.framed && !points.empty()
                             ? framed_eye(a, image, focal, double(scene.near), points, double(margin))
                             : glm::dvec3(scene.eye);
  auto row = [&](glm::dvec3 axis, double scale) {
    return glm::vec4(glm::dvec4(axis, -glm::dot(axis, eye)) * scale);
  };
  Camera c;
  c.row_x = row(a.right, focal);
  c.row_y = row(a.down, focal);
  c.row_w = row(a.forward, 1.0);
  c.eye = glm::vec3(eye);
  c.ray = glm::vec3(a.forward);
  c.ray_dx = glm::vec3(a.right / focal);
  c.ray_dy = glm::vec3(a.down / focal);
  c.pixel = float(1.0 / focal);
  c.near = scene.near;
  c.width = image.width;
  c.height = image.height;
  return c;
}

}  // namespace pelage
