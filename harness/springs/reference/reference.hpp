// The double-precision reference of Banisch and Wuethrich 2006: it follows the paper mass by mass and spring
// by spring and shares no code with the kernels. The results of the kernels are compared with it.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs::reference {

/// Positions (R) and velocities (R/s) of all masses, in the object's frame.
struct State {
  std::vector<glm::dvec3> position, velocity;
};

/// A topology and the forces on it.
struct System {
  const SpringNetwork& topology;
  const Dynamics& dynamics;
  /// Local force on each stick's top mass, N, in the object's frame; empty if there is none.
  std::vector<glm::dvec3> push = {};
};

/// Returns the rest state: every stick points along its normal, and all velocities are 0.
State rest(const SpringNetwork& topology);

/// Returns the force F(t, p, v) of Eq. 1 on every mass, N, at `time` (s). It includes the forces on the fixed
/// masses.
std::vector<glm::dvec3> forces(const System& system, const State& state, double time);

/// Returns the state after one more step dt of the solver in `system.dynamics`. `number` counts the steps
/// done before.
State step(const System& system, const State& state, long number);

/// Returns |b - A x| / |b| of the equations A x = b of backward Euler, where x is `change`, the change of the
/// top masses' velocities (R/s) in the step after `number` steps.
double residual(const System& system, const State& state, long number, const std::vector<glm::dvec3>& change);

/// Returns the kinetic energy plus the potential energy of the springs, J. It excludes the potentials of
/// gravity and of Eq. 5.
double energy(const System& system, const State& state);

/// Returns the position of each top mass relative to its base, R: the kernels' q.
std::vector<glm::dvec3> offsets(const SpringNetwork& topology, const State& state);

}  // namespace pelage::springs::reference
