#include "harness/prepare/uv_scale.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace pelage {

UvScale::UvScale(std::shared_ptr<const Mesh> mesh) : mesh_(std::move(mesh)) {
  std::vector<double> area(mesh_->position.size(), 0.0), uv_area(area);
  for (const glm::uvec3& t : mesh_->triangle) {
    const glm::dvec3 a(mesh_->position[t.x]), b(mesh_->position[t.y]), c(mesh_->position[t.z]);
    const glm::dvec2 o(mesh_->uv[t.x]), d = glm::dvec2(mesh_->uv[t.y]) - o,
                                        e = glm::dvec2(mesh_->uv[t.z]) - o;
    for (int k = 0; k < 3; ++k) {
      area[t[k]] += glm::length(glm::cross(b - a, c - a));
      uv_area[t[k]] += std::abs(d.x * e.y - d.y * e.x);
    }
  }
  const double mean = std::sqrt(double(mesh_->length_per_uv.x) * double(mesh_->length_per_uv.y));
  for (std::size_t i = 0; i < area.size(); ++i)
    length_.push_back(area[i] > 0 && uv_area[i] > 0 ? std::sqrt(area[i] / uv_area[i]) : mean);
}

double UvScale::at(std::size_t face, glm::dvec3 weight) const {
  const glm::uvec3 t = mesh_->triangle[face];
  return weight.x * length_[t.x] + weight.y * length_[t.y] + weight.z * length_[t.z];
}

}  // namespace pelage
