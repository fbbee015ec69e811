// The strand model of S, section 3.2.1. Each triangle has one strand, which is a mass on a spring.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::reference {

/// The state of a strand's mass, relative to the strand's root.
struct Strand {
  glm::dvec3 tip{0.0};       ///< p - p_root, R
  glm::dvec3 velocity{0.0};  ///< R/s
};

/// Applies S Eq. 3. It moves the tip into the half ball of radius `length` on the side of the unit vector
/// `normal`, and removes the component of the velocity that points out of the half ball. It projects the tip
/// first to the half space and then to the ball. The second projection keeps the tip in the half space.
Strand constrain(Strand strand, const glm::dvec3& normal, double length);

/// Returns the strand of `face` at rest. The tip is at the strand's anchor and has the velocity 0.
Strand rest(const FrameInput& input, std::size_t face);

/// Advances `strand`, the strand of the triangle `face`, by one substep: S Eq. 2 by semi-implicit Euler, then
/// S Eq. 3. `index` is the number of earlier substeps since rest. It determines the time in the wind force.
Strand substep(const FrameInput& input, std::size_t face, Strand strand, std::size_t index);

/// Simulates one strand for `frames` frames of scene.dynamics.substeps substeps, from rest.
Strand simulate(const FrameInput& input, std::size_t face, int frames);

/// Simulates all strands. Returns one entry per triangle.
std::vector<Strand> simulate(const FrameInput& input, int frames);

}  // namespace pelage::reference
