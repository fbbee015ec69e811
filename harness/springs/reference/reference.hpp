// The double-precision reference for the mass-spring solvers of Banisch and Wuethrich 2006. It computes each
// mass and each spring separately, as in the paper, and shares no code with the kernels.
#pragma once
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs::reference {

/// Positions (R) and velocities (R/s) of all masses, in the object's frame.
struct State {
  std::vector<glm::dvec3> position, velocity;
};

/// A topology, its dynamics, and the local forces on it.
struct System {
  const SpringNetwork& network;
  const Dynamics& dynamics;
  std::vector<glm::dvec3> push = {};  ///< local force on each top, N, in the object's frame; empty: none
};

/// Returns the rest state: every stick points along its normal, and all velocities are 0.
State rest(const SpringNetwork& network);

/// Returns the force on every mass, also on the fixed ones (F in Eq. 1 of the paper), in newtons, at `time`
/// in seconds.
std::vector<glm::dvec3> forces(const System& system, const State& state, double time);

/// Returns the state after one more time step of the solver in `system.dynamics`. `number` is the index
/// of this step, starting at 0.
State step(const System& system, const State& state, long number);

/// Returns the state after `steps` time steps that begin with step number `first` in the state `state`.
State after(const System& system, State state, long first, long steps);

/// Returns the state at the start of a frame on a moving skin (docs/springs.md, section Moving skin).
/// `network` has the skin of this frame, and `change` is what the velocity of each base changes by. The tops
/// keep their places relative to their bases, and their velocities in the world.
State on_new_skin(const SpringNetwork& network, State state, const std::vector<glm::dvec3>& change);

/// Returns the relative residual |b - A x| / |b| of the linear system A x = b of one backward Euler step. The
/// vector x is `change`, the change of the top masses' velocities (R/s) in this step. `number` is the index
/// of this step, starting at 0.
double residual(const System& system, const State& state, long number, const std::vector<glm::dvec3>& change);

/// The derivatives of the forces on the tops with respect to their positions (in N/R) and to their velocities
/// (in N s/R), as square matrices with `size` rows, stored row by row. Row and column 3 i + c belong to
/// component c of the top of stick i.
struct Derivatives {
  std::size_t size = 0;
  std::vector<double> by_position, by_velocity;
};
/// Returns the derivatives that backward Euler uses at `time`. If `full_jacobian` of the dynamics is false,
/// the matrices lack the terms that docs/springs.md names in the section Solvers. The matrices are dense, so
/// use this function only for small systems.
Derivatives derivatives(const System& system, const State& state, double time);

/// Returns the kinetic energy plus the potential energy of the springs, in joules, without that of gravity.
/// The return force (Eq. 5 of the paper) has no potential energy (its derivative is not symmetric).
double energy(const System& system, const State& state);

/// Returns energy() plus the potential energy of gravity, in joules. This sum is constant in a conservative
/// system, that is, on an object at rest without wind, drag, damping and return force.
double total_energy(const System& system, const State& state);

/// Returns the position of each top relative to its base, in R (q in the kernels).
std::vector<glm::dvec3> offsets(const SpringNetwork& network, const State& state);

}  // namespace pelage::springs::reference

namespace pelage::springs {

/// State of a selection of sticks after some frames that start from rest.
struct SomeSticks {
  std::vector<std::uint32_t> stick;  ///< indices of the sticks, ascending
  std::vector<glm::dvec3> offset;    ///< per stick: position of the top mass relative to the base, in R
  std::vector<glm::dvec3> velocity;  ///< per stick: velocity of the top mass in R/s, in the object's frame
};
/// Computes the state of about `count` sticks with evenly spaced indices, or of all sticks of the topology
/// prisms, in which each stick depends on all others. Calls `each` with the offsets after each frame.
SomeSticks some_reference_sticks(const FrameInput& input, int frames, std::size_t count,
                                 const std::function<void(const std::vector<glm::dvec3>&)>& each = {});

}  // namespace pelage::springs
