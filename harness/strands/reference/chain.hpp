// The double-precision reference for the simulation of strands (docs/strands.md, section "Chains"). It
// computes one strand at a time and shares no code with the kernels. It solves the equations of a step as a
// dense linear system, and finds the points at which segments touch the skin by bisection. The kernels have
// closed formulas for both tasks. Tests compare the kernels' results with the reference.
#pragma once
#include <array>
#include <glm/vec3.hpp>

#include "harness/contact/reference/colliders.hpp"
#include "harness/strands/chain/chain.hpp"

namespace pelage::strands::reference {

/// The state of one strand, like ChainState, in double precision.
struct State {
  glm::dvec3 u{0};               ///< direction of the first segment in the world, unit vector
  glm::dvec3 w{0};               ///< direction of the second segment in the world, unit vector
  glm::dvec3 a{0};               ///< derivative of u with respect to time, orthogonal to u, rad/s
  glm::dvec3 b{0};               ///< derivative of w with respect to time, orthogonal to w, rad/s
  std::array<double, 4> stop{};  ///< impulses of the stops 0 to 3 in the last step, at least 0
  std::array<double, 2> body{};  ///< impulses of the stops 4 and 5 in the last step, at least 0
};

/// Converts a state to double precision. The directions become unit vectors in double precision.
State in_double(const ChainState& state);

/// The skin at a root at one time, in the world.
struct SkinPoint {
  glm::dvec3 velocity{0};      ///< of the root, R/s
  glm::dvec3 acceleration{0};  ///< of the root, R/s^2
  glm::dvec3 rest{0, 1, 0};    ///< direction of the strand at rest, of any length above 0
  glm::dvec3 normal{0, 1, 0};  ///< normal of the skin, of any length above 0
};

/// Returns the state at time 0 of a strand at rest: both segments point in the rest direction, and the rates
/// are 0.
State at_rest(const Chain& chain);

/// Returns the state after one more time step. `number` is the index of this step, starting at 0, and h is
/// the time step. The step uses the external forces, the rest direction and the normal at its end, which is
/// the time (number + 1) h. The values in `chain` and `dynamics` must be in their valid ranges. `skin` is the
/// moving skin at this time, or null. With a moving skin, the object must not move (ChainDynamics::motion),
/// and there must be no body.
State step(const Chain& chain, const ChainDynamics& dynamics, const State& state, long number,
           const SkinPoint* skin = nullptr);

/// Returns the state after colliders have pushed the joint and then the tip (docs/colliders.md). The object
/// must not move.
State pushed(const Chain& chain, const ChainDynamics& dynamics, const State& state,
             const pelage::reference::Colliders& colliders);

/// Returns the kinetic energy plus the potential energy at `time` in seconds. The potential energy contains
/// the springs, gravity, the acceleration of the root, and the drag of the wind on a strand with the rates 0.
/// The unit is the strand's mass times L^2 / s^2.
double energy(const Chain& chain, const ChainDynamics& dynamics, const State& state, double time);

}  // namespace pelage::strands::reference
