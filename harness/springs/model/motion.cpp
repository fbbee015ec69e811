#include "harness/springs/model/motion.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace pelage::springs {

Wind wind_of(const WindScene& w, float drag) {
  return {w.direction, drag > 0 ? w.strength / drag : 0, w.gust, w.frequency, w.wavelength};
}

Motion motion_of(const MotionScene& m) {
  return {m.velocity, m.shake, m.shake_frequency, m.axis, m.spin, m.swing, m.swing_frequency};
}

bool turns(const Motion& m) {
  return m.spin != 0 || (m.swing != 0 && m.swing_frequency != 0);
}

Pose pose_at(const Motion& m, double time) {
  constexpr double turn = 2 * std::numbers::pi;
  const double a = turn * double(m.shake_frequency), b = turn * double(m.swing_frequency);
  return {glm::dvec3(m.velocity) + a * std::sin(a * time) * glm::dvec3(m.shake),
          a * a * std::cos(a * time) * glm::dvec3(m.shake),
          glm::normalize(glm::dvec3(m.axis)),
          double(m.spin) * time + double(m.swing) * std::sin(b * time),
          double(m.spin) + double(m.swing) * b * std::cos(b * time),
          -double(m.swing) * b * b * std::sin(b * time)};
}

// Rodrigues' formula.
glm::dvec3 turned(glm::dvec3 v, glm::dvec3 axis, double angle) {
  return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
         axis * glm::dot(axis, v) * (1 - std::cos(angle));
}

}  // namespace pelage::springs
