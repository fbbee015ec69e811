// The dynamics (forces, motion of the object, solver and time step) that the tests in tests/springs use.
#pragma once
#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs::test {

inline constexpr float fur_length = 0.05f;

/// Returns dynamics with all effects: gravity, gusts, and an object that travels, shakes, spins and swings.
inline Dynamics lively(Solver solver) {
  Dynamics d;
  d.solver = solver;
  d.step = solver == Solver::explicit_euler ? 1e-3f : 1.0f / 240;
  d.wind = {{1, 0.2f, 0.5f}, 3, 0.4f, 1, 0.7f};
  d.motion = {{0.3f, 0, 0.1f}, {0.02f, 0.05f, -0.01f}, 1.3f, {0.3f, 1, 0.2f}, 0.7f, 0.4f, 1.1f};
  return d;
}

/// Returns dynamics in gusts, with an object at rest: those of experiments/banisch2006-longest-step.toml with
/// the spring constant k = 10 N/m.
inline Dynamics windy(Solver solver) {
  Dynamics d;
  d.solver = solver;
  d.wind = {{1, 0.2f, 0.5f}, 3, 0.4f, 1, 1};
  return d;
}

/// Returns dynamics with only springs and the return force (Eq. 5 of Banisch and Wuethrich 2006): no gravity,
/// wind or drag, and an object at rest.
inline Dynamics still(Solver solver) {
  Dynamics d;
  d.solver = solver;
  d.gravity = {0, 0, 0};
  d.drag = 0;
  return d;
}

}  // namespace pelage::springs::test
