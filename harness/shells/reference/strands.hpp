// The strand model of S 3.2.1: one mass on a spring per triangle.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::reference {

/// One mass; everything relative to its root.
struct Strand {
  glm::dvec3 tip{0.0};       ///< p - p_root, R
  glm::dvec3 velocity{0.0};  ///< R/s
};

/// S Eq. 3: the tip stays in the half ball of radius `length` over the surface with unit normal `normal`; the
/// velocity loses what would leave it. First the half space, then the ball (the ball's projection keeps the
/// half space).
Strand constrain(Strand strand, const glm::dvec3& normal, double length);

/// The strand of `face` at rest: on its anchor, still.
Strand rest(const FrameInput& input, std::size_t face);

/// Substep number `index` since rest (S Eq. 2, semi-implicit Euler, then Eq. 3).
Strand substep(const FrameInput& input, std::size_t face, Strand strand, std::size_t index);

/// `frames` frames of scene.dynamics.substeps substeps, from rest.
Strand simulate(const FrameInput& input, std::size_t face, int frames);

/// All strands, F.
std::vector<Strand> simulate(const FrameInput& input, int frames);

}  // namespace pelage::reference
