#include "harness/shells/reference/substeps.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace pelage::reference {

glm::dvec3 root_shift(const glm::dvec3& step, const glm::dvec3& normal, const glm::dvec3& eye) {
  const double cosine = glm::dot(eye, normal);
  const double e = cosine < 0.0 ? std::min(cosine, -0.25) : std::max(cosine, 0.25);
  return step - glm::dot(step, normal) / e * eye;
}

glm::dvec2 uv_shares(const glm::dvec3& delta, const glm::dvec3& t, const glm::dvec3& b) {
  const double tt = glm::dot(t, t), bb = glm::dot(b, b), tb = glm::dot(t, b), q = tt * bb - tb * tb;
  if (q <= 1e-6 * tt * bb) return glm::dvec2(0.0);
  const double dt = glm::dot(delta, t), db = glm::dot(delta, b);
  return {(dt * bb - db * tb) / q, (db * tt - dt * tb) / q};
}

FurSample combined(const std::vector<FurSample>& samples) {
  double clear = 1.0, coverage = 0.0, shade = 0.0;
  for (const FurSample& sample : samples) {
    clear *= 1.0 - sample.coverage;
    coverage += sample.coverage;
    shade += sample.coverage * sample.shade;
  }
  return {1.0 - std::pow(clear, 1.0 / double(samples.size())), coverage > 0.0 ? shade / coverage : 0.0};
}

}  // namespace pelage::reference
