// The equations of kernels/rasterize compiled in double precision, and their vectors as those of GLM.
#pragma once
#include <glm/vec3.hpp>

#include "tests/support/opencl_as_cpp.hpp"

namespace pelage::in_double {
// clang-format off
#include "rasterize/equations.clh"
// clang-format on

inline real3 shim_of(const glm::dvec3& v) {
  return vec3(v.x, v.y, v.z);
}
inline glm::dvec3 glm_of(const real3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace pelage::in_double
