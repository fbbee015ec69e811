#include "harness/compare/sticks.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/compare/tolerances.hpp"
#include "harness/scene/spring_kinds.hpp"
#include "harness/springs/reference/reference.hpp"

namespace pelage {

std::vector<Check> check_sticks(const FrameInput& input, int frames, const std::vector<glm::vec3>& offsets) {
  const springs::SomeSticks expected = springs::some_reference_sticks(input, frames, kCheckSticks);
  std::vector<double> error;
  double square = 0;
  for (std::size_t i = 0; i < expected.stick.size(); ++i) {
    const glm::dvec3 off = glm::dvec3(offsets.at(expected.stick[i])) - expected.offset[i];
    const double share = glm::length(off) / double(input.scene.fur.length);
    error.push_back(std::isfinite(share) ? share : 1e6);
    square += error.back() * error.back();
  }
  std::sort(error.begin(), error.end());
  if (!springs::kind_of(input.scene.dynamics.topology).shared_edges())
    return {{"double-precision masses", "largest error / L0", error.back(), tolerance::stick_top, false}};
  return {{"double-precision masses", "rms error / L0", std::sqrt(square / double(error.size())),
           tolerance::prisms_rms, false},
          {"double-precision masses", "p99 error / L0", error[error.size() * 99 / 100], tolerance::prisms_p99,
           false}};
}

}  // namespace pelage
