#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace pelage::strands {

/// Copies a vector into an array of a struct that the host passes to kernels.
inline void copy(float* to, glm::vec3 v) {
  for (int i = 0; i < 3; ++i) to[i] = v[i];
}
inline void copy(float* to, glm::vec4 v) {
  for (int i = 0; i < 4; ++i) to[i] = v[i];
}

}  // namespace pelage::strands
