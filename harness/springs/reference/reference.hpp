// Banisch and Wuethrich 2006 in double precision, mass by mass and spring by spring as the paper says it,
// written without the kernels: what they are held against.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs::reference {

/// Of all masses, in the object's frame: R and R/s.
struct State {
  std::vector<glm::dvec3> position, velocity;
};

/// A topology in the hands of its forces.
struct System {
  const SpringNetwork& topology;
  const Dynamics& dynamics;
  std::vector<glm::dvec3> push =
      {};  ///< local force on each stick's top, N, in the object's frame; empty: none
};

/// Every stick along its normal, nothing moves.
State rest(const SpringNetwork& topology);

/// F(t, p, v) of Eq. 1 on every mass, N; time in s. Forces on the fixed masses of the skin are reported too.
std::vector<glm::dvec3> forces(const System& system, const State& state, double time);

/// The state one dt later, by the dynamics' solver; `number` steps were done before.
State step(const System& system, const State& state, long number);

/// |b - A x| / |b| of the equations A x = b that backward Euler solves for the change x of the tops'
/// velocities.
double residual(const System& system, const State& state, long number, const std::vector<glm::dvec3>& change);

/// Kinetic energy and the springs' potential energy, J. Weight, drag, wind and Eq. 5 have no part in it.
double energy(const System& system, const State& state);

/// Offset of each top from its base, R: the kernels' q.
std::vector<glm::dvec3> offsets(const SpringNetwork& topology, const State& state);

}  // namespace pelage::springs::reference
