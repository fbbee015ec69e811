#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/strands/reference/drawing.hpp"

namespace pelage::strands::reference {
namespace {

using Vec = glm::dvec3;

/// The part of v that is parallel to the plane with the normal n, normalized.
Vec along_plane(Vec v, Vec n) {
  return glm::normalize(v - glm::dot(v, n) * n);
}

/// Returns v, rotated about a unit vector by an angle in degrees.
Vec rotated(Vec v, Vec axis, float degrees) {
  const double angle = double(degrees) * std::numbers::pi / 180;
  const Vec along = glm::dot(axis, v) * axis;
  return along + std::cos(angle) * (v - along) + std::sin(angle) * glm::cross(axis, v);
}

}  // namespace

DrawnStrand between(const std::vector<KeyStrand>& keys, const KeyedStrand& strand, float first_segment) {
  const double s = strand.weight.x, t = strand.weight.y;
  const auto mean = [&](glm::vec3 KeyStrand::*vector) {
    return (1 - s - t) * Vec(keys[strand.key[0]].*vector) + s * Vec(keys[strand.key[1]].*vector) +
           t * Vec(keys[strand.key[2]].*vector);
  };
  const Vec root = mean(&KeyStrand::root), n = glm::normalize(mean(&KeyStrand::normal));
  const Vec rest = glm::normalize(mean(&KeyStrand::rest));
  const auto moved = [&](Vec v) { return glm::normalize(rest + double(strand.response) * (v - rest)); };
  Vec u = moved(glm::normalize(mean(&KeyStrand::first))), w = moved(glm::normalize(mean(&KeyStrand::second)));
  u = rotated(u, n, strand.twist);
  w = rotated(w, n, strand.twist);
  if (const Vec axis = glm::cross(n, u); glm::length(axis) > 1e-9)
    w = rotated(w, glm::normalize(axis), strand.curvature);
  const double l1 = first_segment, l2 = 1 - l1;
  if (glm::dot(n, u) < 0) u = along_plane(u, n);
  if (l1 * glm::dot(n, u) + l2 * glm::dot(n, w) < 0) {
    const double sine = -l1 / l2 * glm::dot(n, u);
    w = sine * n + std::cos(std::asin(sine)) * along_plane(w, n);
  }
  DrawnStrand drawn;
  const Vec joint = root + l1 * double(strand.length) * u;
  drawn.point = {glm::vec3(root), glm::vec3(joint), glm::vec3(joint + l2 * double(strand.length) * w)};
  drawn.normal = glm::vec3(n);
  drawn.colour = glm::vec3(strand.colour[0], strand.colour[1], strand.colour[2]) / 255.0f;
  drawn.width = strand.width;
  drawn.layer = drawn.rank = strand.layer;
  return drawn;
}

}  // namespace pelage::strands::reference
