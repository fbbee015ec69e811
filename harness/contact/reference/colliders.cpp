#include "harness/contact/reference/colliders.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace pelage::reference {
namespace {

constexpr int march_steps = 16, halvings = 8;

/// Returns the point of the segment from a to b that is nearest to p.
glm::dvec3 nearest_on(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& p) {
  const glm::dvec3 axis = b - a;
  const double square = glm::dot(axis, axis);
  return square > 0.0 ? a + std::clamp(glm::dot(p - a, axis) / square, 0.0, 1.0) * axis : a;
}

Pushed stopped(Pushed mass, double depth, const glm::dvec3& n, const glm::dvec3& velocity) {
  mass.place += depth * n;
  mass.velocity -= std::min(0.0, glm::dot(mass.velocity - velocity, n)) * n;
  return mass;
}

/// Returns the derivatives of the field with respect to the position: those of the trilinear interpolation.
glm::dvec3 slope_at(const DistanceField& field, const glm::dvec3& point) {
  // The interpolation is linear along each axis within a cell. A difference over a part of the cell around
  // the point is therefore exact.
  glm::dvec3 slope;
  for (int k = 0; k < 3; ++k) {
    const double at = std::clamp((point[k] - double(field.origin[k])) / double(field.cell), 0.0,
                                 double(field.nodes[k] - 1));
    const double cell = std::min(std::floor(at), double(field.nodes[k] - 2));
    glm::dvec3 low = point, high = point;
    low[k] = double(field.origin[k]) + (cell + 0.25) * double(field.cell);
    high[k] = double(field.origin[k]) + (cell + 0.75) * double(field.cell);
    slope[k] = (value_at(field, high) - value_at(field, low)) / (0.5 * double(field.cell));
  }
  return slope;
}

/// Returns the index of the file whose shape the mesh has at the end of interval `interval` - 1.
std::size_t file_of(const ContactMeshScene& mesh, double interval) {
  const double count = mesh.frames;
  return std::size_t(mesh.after_frames == "repeat" ? interval - count * std::floor(interval / count)
                                                   : std::min(interval, count - 1));
}

}  // namespace

Colliders::Colliders(const Scene& scene, const ContactFields& fields, double time) {
  for (const ContactSphereScene& s : scene.contact.spheres) {
    const glm::dvec3 centre = s.motion.moved(s.centre, time);
    if (s.motion.exists(time))
      capsules_.push_back({centre, centre, double(s.radius), glm::dvec3(s.motion.velocity)});
  }
  for (const ContactCapsuleScene& c : scene.contact.capsules)
    if (c.motion.exists(time))
      capsules_.push_back({c.motion.moved(c.from, time), c.motion.moved(c.to, time), double(c.radius),
                           glm::dvec3(c.motion.velocity)});
  const ContactMeshScene& mesh = scene.contact.mesh;
  if (fields.empty() || !mesh.motion.exists(time)) return;
  const double since = time - double(mesh.motion.begin);
  duration_ = double(scene.dynamics.step) * static_cast<double>(scene.dynamics.substeps);
  const double interval = std::floor(since / duration_);
  share_ = since / duration_ - interval;
  field_ = {fields[file_of(mesh, interval)].get(), fields[file_of(mesh, interval + 1)].get()};
  position_ = mesh.motion.moved(mesh.position, time);
  velocity_ = glm::dvec3(mesh.motion.velocity);
  axis_ = glm::normalize(glm::dvec3(mesh.axis));
  spin_ = double(mesh.spin);
  angle_ = spin_ * since;
  scale_ = double(mesh.scale);
}

/// Rodrigues' formula.
glm::dvec3 Colliders::turned(const glm::dvec3& v, double angle) const {
  return std::cos(angle) * v + std::sin(angle) * glm::cross(axis_, v) +
         (1 - std::cos(angle)) * glm::dot(axis_, v) * axis_;
}

/// Returns a point in the axes and the unit of length of the mesh.
glm::dvec3 Colliders::in_mesh(const glm::dvec3& point) const {
  return turned(point - position_, -angle_) / scale_;
}

double Colliders::mesh_distance(const glm::dvec3& point) const {
  const glm::dvec3 y = in_mesh(point);
  return scale_ * ((1 - share_) * value_at(*field_[0], y) + share_ * value_at(*field_[1], y));
}

double Colliders::distance(const glm::dvec3& point) const {
  double least = std::numeric_limits<double>::max();
  for (const Capsule& c : capsules_)
    least = std::min(least, glm::length(point - nearest_on(c.from, c.to, point)) - c.radius);
  return field_[0] ? std::min(least, mesh_distance(point)) : least;
}

Pushed Colliders::push(Pushed mass, const glm::dvec3& root, const glm::dvec3& normal) const {
  for (const Capsule& c : capsules_) {
    const glm::dvec3 from = root + mass.place - nearest_on(c.from, c.to, root + mass.place);
    const double distance = glm::length(from);
    if (distance < c.radius)
      mass = stopped(mass, c.radius - distance, distance > 1e-12 ? from / distance : normal, c.velocity);
  }
  if (!field_[0]) return mass;
  const glm::dvec3 point = root + mass.place;
  const double distance = mesh_distance(point);
  if (distance >= 0.0) return mass;
  const glm::dvec3 y = in_mesh(point);
  const glm::dvec3 slope =
      turned((1 - share_) * slope_at(*field_[0], y) + share_ * slope_at(*field_[1], y), angle_);
  glm::dvec3 velocity = velocity_ + glm::cross(spin_ * axis_, point - position_);
  const double steep = glm::length(slope);
  if (!(steep > 1e-12)) return stopped(mass, -distance, normal, velocity);
  // The surface is where f = 0, so its velocity u along the slope of f satisfies df/dt + u |slope| = 0.
  const double change = scale_ * (value_at(*field_[1], y) - value_at(*field_[0], y)) / duration_;
  velocity -= change / steep * (slope / steep);
  return stopped(mass, -distance, slope / steep, velocity);
}

glm::dvec3 Colliders::kept(const glm::dvec3& root, const glm::dvec3& along) const {
  if (!(glm::length(along) > 0.0)) return along;
  const auto in_capsule = [&](const Capsule& c, double share) {
    const glm::dvec3 p = root + share * along;
    return glm::length(p - nearest_on(c.from, c.to, p)) < c.radius;
  };
  double share = 1.0;
  // A collider may move the vertex into another one. Each pass moves it out of at least one collider.
  for (std::size_t pass = 0; pass < capsules_.size() + 1; ++pass) {
    for (const Capsule& c : capsules_) {
      if (!in_capsule(c, share)) continue;
      // A capsule is convex, so the points of the line inside the capsule form one interval. If the root is
      // inside, the result is 0. Otherwise bisection finds the lower end of the interval.
      double low = 0.0, high = share;
      if (in_capsule(c, 0.0)) high = 0.0;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (in_capsule(c, middle) ? high : low) = middle;
      }
      share = low;
    }
    if (!field_[0] || mesh_distance(root + share * along) >= 0.0) continue;
    const auto outside = [&](double at) { return mesh_distance(root + at * along) >= 0.0; };
    const double start = share;
    share = 0.0;
    for (int k = 1; k < march_steps; ++k) {
      double low = start * (1.0 - double(k) / march_steps);
      if (!outside(low)) continue;
      double high = start * (1.0 - double(k - 1) / march_steps);
      for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (outside(middle) ? low : high) = middle;
      }
      share = low;
      break;
    }
  }
  return share * along;
}

}  // namespace pelage::reference
