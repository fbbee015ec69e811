#include "harness/strands/body/skin.hpp"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "harness/error.hpp"

namespace pelage::strands {
namespace {

/// Rotates v by the smallest rotation from the unit vector `from` to the unit vector `to`.
glm::dvec3 swung(glm::dvec3 v, glm::dvec3 from, glm::dvec3 to) {
  const glm::dvec3 axis = glm::cross(from, to);
  const double cosine = glm::dot(from, to);
  if (cosine < -1 + 1e-9) return -v + 2.0 * glm::dot(v, any_tangent(from)) * any_tangent(from);
  return v + glm::cross(axis, v) + glm::cross(axis, glm::cross(axis, v)) / (1 + cosine);
}

}  // namespace

std::vector<glm::dvec3> normals_of(const Skin& skin, const std::vector<glm::vec3>& position) {
  std::vector<glm::dvec3> normals(position.size(), glm::dvec3(0));
  for (const glm::uvec3& t : skin.triangle) {
    const glm::dvec3 a(position[t.x]), b(position[t.y]), c(position[t.z]);
    for (int k = 0; k < 3; ++k) normals[t[k]] += glm::cross(b - a, c - a);
  }
  for (std::size_t i = 0; i < normals.size(); ++i)
    normals[i] = glm::length(normals[i]) > 0 ? glm::normalize(normals[i]) : skin.normal[i];
  return normals;
}

SkinMotion::SkinMotion(const Mesh& mesh, std::vector<std::uint32_t> point, std::vector<glm::vec3> rest)
    : skin_(weld(mesh)), point_(std::move(point)), rest_(std::move(rest)) {
  if (rest_.size() != point_.size())
    throw InputError(fmt::format("rest directions: {} for {} strands; both counts must be equal",
                                 rest_.size(), point_.size()));
  for (const std::uint32_t p : point_)
    if (p >= mesh.welded)
      throw InputError(
          fmt::format("surface point {} of a strand: the mesh has {} surface points", p, mesh.welded));
}

SkinFrame SkinMotion::next(const std::vector<glm::vec3>& position, double duration) {
  if (position.size() != skin_.position.size())
    throw InputError(fmt::format("positions of the skin: {} for {} surface points; both counts must be equal",
                                 position.size(), skin_.position.size()));
  if (!(duration > 0)) throw InputError("duration of a frame of the skin (s): it must be above 0");
  SkinFrame f;
  const std::vector<glm::dvec3> normals = normals_of(skin_, position);
  for (std::size_t strand = 0; strand < point_.size(); ++strand) {
    const std::uint32_t i = point_[strand];
    const glm::dvec3 n = normals[i], x0(position[i]);
    double across = 0, along = 0;
    for (std::uint32_t k = skin_.row[i]; k < skin_.row[i + 1]; ++k)
      for (int corner = 0; corner < 3; ++corner) {
        const std::uint32_t other = skin_.triangle[skin_.face[k]][corner];
        const glm::dvec3 old =
            tangential(swung(skin_.position[other] - skin_.position[i], skin_.normal[i], n), n);
        const glm::dvec3 now = tangential(glm::dvec3(position[other]) - x0, n);
        across += glm::dot(n, glm::cross(old, now));
        along += glm::dot(old, now);
      }
    const double angle = std::atan2(across, along);
    const glm::dvec3 d = swung(glm::dvec3(rest_[strand]), skin_.normal[i], n), up = glm::dot(d, n) * n;
    const glm::dvec3 turned = up + std::cos(angle) * (d - up) + std::sin(angle) * glm::cross(n, d);
    f.root.push_back(position[i]);
    f.rest.push_back(glm::vec3(glm::normalize(turned)));
    f.normal.push_back(glm::vec3(n));
    glm::dvec3 velocity(0), acceleration(0);
    if (before_.size() == 1) velocity = (x0 - glm::dvec3(before_[0][i])) / duration;
    if (before_.size() == 2) {
      const glm::dvec3 x1(before_[0][i]), x2(before_[1][i]);
      velocity = (3.0 * x0 - 4.0 * x1 + x2) / (2 * duration);
      acceleration = (x0 - 2.0 * x1 + x2) / (duration * duration);
    }
    f.velocity.push_back(glm::vec3(velocity));
    f.acceleration.push_back(glm::vec3(acceleration));
  }
  before_.insert(before_.begin(), position);
  if (before_.size() > 2) before_.pop_back();
  return f;
}

}  // namespace pelage::strands
