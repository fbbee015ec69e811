#include "harness/prepare/camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/error.hpp"

namespace pelage {
namespace {

constexpr double fill_height = 0.85, fill_width = 0.94;
constexpr int framing_steps = 40;

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

struct Box {
  double x0 = 1e30, x1 = -1e30, y0 = 1e30, y1 = -1e30;
  bool behind = false;
};

Box screen_box(const Axes& a, glm::dvec3 eye, double focal, double near, std::span<const glm::vec3> points,
               double margin) {
  Box box;
  for (const glm::vec3& p : points) {
    const glm::dvec3 q = glm::dvec3(p) - eye;
    const double w = glm::dot(a.forward, q);
    if (w <= near) {
      box.behind = true;
      return box;
    }
    const double x = focal * glm::dot(a.right, q) / w, y = focal * glm::dot(a.down, q) / w;
    const double m = focal * margin / w;
    box.x0 = std::min(box.x0, x - m);
    box.x1 = std::max(box.x1, x + m);
    box.y0 = std::min(box.y0, y - m);
    box.y1 = std::max(box.y1, y + m);
  }
  return box;
}

/// The eye from which `points` fill the picture: shifts sideways to centre them and moves along the view axis
/// until the tighter of height and width fits.
glm::dvec3 framed_eye(const Axes& a, const ImageScene& image, double focal, double near,
                      std::span<const glm::vec3> points, double margin) {
  double distance = 4.0;
  glm::dvec3 target(0);
  for (int step = 0; step < framing_steps; ++step) {
    const Box box = screen_box(a, target - distance * a.forward, focal, near, points, margin);
    if (box.behind) {
      distance *= 1.5;
      continue;
    }
    target += distance / focal * 0.5 * ((box.x0 + box.x1) * a.right + (box.y0 + box.y1) * a.down);
    const double fill = std::max((box.y1 - box.y0) / (fill_height * image.height),
                                 (box.x1 - box.x0) / (fill_width * image.width));
    distance *= std::clamp(fill, 0.5, 2.0);
  }
  return target - distance * a.forward;
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
