// The strand model of section 3.2.1 of S: each triangle has one strand, which is a mass on a spring.
// Lengths are in R.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/contact/reference/colliders.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::reference {

/// The state of a strand's mass, relative to the strand's root.
struct Strand {
  glm::dvec3 tip{0.0};       ///< position of the mass minus position of the root, in R
  glm::dvec3 velocity{0.0};  ///< in R/s
};

/// Applies S Eq. 3, by which the tip stays in a half ball. The half ball has its centre at the root and the
/// radius `length`. It lies on the side to which the unit vector `normal` points. The function projects the
/// tip first to the half space and then to the ball; the second projection keeps the tip in the half space.
/// The function also removes the component of the velocity that points out of the half ball.
Strand constrain(Strand strand, const glm::dvec3& normal, double length);

/// Returns the strand of `face` at rest. The tip is at the strand's anchor and has the velocity 0.
Strand rest(const FrameInput& input, std::size_t face);

/// The forces of the simulated frames of a scene, from the frame number `first` on. A scene whose forces have
/// keyframes has other forces in each frame.
class FrameForces {
 public:
  FrameForces(const FrameInput& input, int first, int frames);
  /// Returns the dynamics in a substep, which is numbered from rest.
  const DynamicsScene& at(std::size_t substep) const;
  bool change() const { return !frame_.empty(); }

 private:
  const DynamicsScene& always_;
  std::size_t first_;
  std::vector<DynamicsScene> frame_;  ///< empty if all frames have the same forces
};

/// Advances `strand`, the strand of the triangle `face`, by one substep. Integrates S Eq. 2 by semi-implicit
/// Euler, moves the strand out of the colliders, and then applies S Eq. 3. `index` is the number of earlier
/// substeps since rest. `index` determines the time in the wind force, and the frame.
Strand substep(const FrameInput& input, const FrameForces& forces, std::size_t face, Strand strand,
               std::size_t index);
Strand substep(const FrameInput& input, std::size_t face, Strand strand, std::size_t index);

/// Simulates one strand for `frames` frames from rest. A frame has scene.dynamics.substeps substeps.
Strand simulate(const FrameInput& input, std::size_t face, int frames);

/// Simulates all strands. Returns one entry per triangle.
std::vector<Strand> simulate(const FrameInput& input, int frames);

/// Returns the time of the picture after `frames` frames, in s.
double time_after(const DynamicsScene& dynamics, int frames);

}  // namespace pelage::reference
