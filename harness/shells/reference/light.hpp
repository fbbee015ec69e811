// The shadow of fur on itself with shading.self_shadow "traced" (docs/shells.md, section 6).
#pragma once
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "harness/prepare/frame_input.hpp"

namespace pelage::reference {

/// The fragment from which a ray goes to the first light.
struct LightRay {
  int layer;          ///< n, or -1 for the base surface
  glm::dvec2 root;    ///< uv + d, the root of the fragment's strand
  glm::dvec3 normal;  ///< nu, outwards
  glm::dvec3 t, b;    ///< tangents of the surface
  double level;       ///< mip level of the fragment's texture lookup
  /// The fragment's strand on layer m minus the same strand on the fragment's layer, with the curl, in R.
  std::function<glm::dvec3(int m)> rise;
  /// The clump's displacement d on layer m minus that on the fragment's layer, in UV.
  std::function<glm::dvec2(int m)> pull;
};

/// Returns T, the part of the first light that reaches the fragment; 1 unless shading.self_shadow is
/// "traced".
double light_through(const FrameInput& input, const LightRay& ray);

}  // namespace pelage::reference
